// What is measured: meshes, rays and times of the quick and the full mode.
#pragma once

#include "measure/timing.h"

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::calibration {

struct MeshPlan {
    std::string scene; // of workloads::scenes()
    std::uint64_t triangles;
};

struct Plan {
    std::string mode; // "quick" or "full"
    std::vector<MeshPlan>
        meshes;         // in the order of measuring: whenever time runs out, small and large ones have been measured
    std::uint64_t rays; // of each kind, at most
    TimingLimits ray_timing;   // of one structure, ray kind and mesh
    double most_call_ns;       // a batch that would take longer gets fewer rays,
    std::uint64_t fewest_rays; // but no fewer than this
    TimingLimits build_timing; // of one structure and mesh
    double time_limit;         // seconds; the mesh in work is finished
};

Plan quick_plan();
Plan full_plan();

} // namespace raywise::calibration
