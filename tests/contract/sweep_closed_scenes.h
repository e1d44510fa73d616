// The closed meshes of the watertightness sweep.
#pragma once

#include "contract/sweep_closed.h"

#include <cstdint>
#include <vector>

namespace raywise::sweep {

struct ClosedScene {
    oracle::Scene mesh; // welded
    bool float32 = false;
    bool convex = false;
    double radius = 1.0; // of the bounding sphere around the middle of the box
    std::vector<Edge> edges;
    std::vector<InsidePoint> inside; // at least one
};

// A torus around the z axis: closed, not convex.
oracle::Scene torus(int around, int across);
// The cube from -1 to 1, each face of cells * cells squares: coplanar neighbours, and coordinates that are short fractions.
oracle::Scene grid_box(int cells);

// Spheres, boxes and tori, as they are and moved and scaled to the ends of what coordinates can be; and those of the real
// meshes, of at most so many triangles, that are closed.
std::vector<ClosedScene> closed_scenes(std::uint64_t most_triangles, bool real);

// Finds out all about a mesh that has to be closed; throws std::runtime_error when it is not, or has no inside.
ClosedScene closed_scene(oracle::Scene mesh);

} // namespace raywise::sweep
