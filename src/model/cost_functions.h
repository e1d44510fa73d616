// What a structure will cost: build, ray and bytes as functions of the scene. One line per structure in
// cost_functions.cpp.
#pragma once

#include "model/constants.h"
#include "model/workload.h"

namespace raywise {

struct Cost {
    double build_ns = 0.0;
    double ray_ns = 0.0; // per ray
    double bytes = 0.0;
    double error = 0.0; // relative; the larger residual of build and ray

    double total_ns(double rays) const { return build_ns + rays * ray_ns; }
};

// The quantity a structure's build and ray time grow with: N, N log2 N, log2 N, N^(1/3) ... of N >= 0 triangles.
// Calibration fits its lines over the same functions.
double build_unit(Structure structure, double triangles);
double ray_unit(Structure structure, double triangles);
const char* build_unit_name(Structure structure);
const char* ray_unit_name(Structure structure);

// Whether the structure needs a view to differ from another candidate; without one it is no candidate.
bool needs_view(Structure structure);

// The same scan when it reads the caller's arrays: it builds nothing, and each ray gathers the triangles on its way.
Cost scan_in_place(const MachineConstants& constants, const Cost& gathered);

Cost predict(Structure structure, const MachineConstants& constants, const SceneFeatures& features,
             const Workload& workload);

} // namespace raywise
