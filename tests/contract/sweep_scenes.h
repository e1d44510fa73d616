// The scenes of the agreement sweep: hard ones at all hard scales, procedural ones, real meshes where there are any.
#pragma once

#include "oracle/scenes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::sweep {

struct SweepScene {
    std::string family;
    oracle::Scene mesh;
    bool float32 = false; // every coordinate is a float32 number
    Vec3 center{0.0};
    double radius = 1.0; // of the bounding sphere
    // Where its views are from: rays are made for them, and structures that project are built for them.
    Vec3 eye{0.0};
    Vec3 light{0.0};
    Vec3 sun{0.0};
};

struct SceneChoice {
    bool hard = true;
    bool procedural = true;
    bool real = true;
    std::vector<std::uint64_t> sizes; // triangles of the procedural scenes, each at every size
    std::uint64_t most_triangles = 0; // larger real meshes are left out
};

std::vector<SweepScene> sweep_scenes(const SceneChoice& choice);

// Fills in all but the family and the mesh.
SweepScene with_views(std::string family, oracle::Scene mesh);

} // namespace raywise::sweep
