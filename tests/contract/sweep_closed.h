// Which meshes are closed, which of those convex, and which points lie inside.
#pragma once

#include "contract/sweep_random.h"
#include "oracle/scenes.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace raywise::sweep {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// The same mesh with vertices of equal coordinates made one: scanned and exported meshes often hold them apart.
oracle::Scene welded(oracle::Scene mesh);

// Every edge once, lower number first; the mesh has to be welded.
std::vector<Edge> edges_of(const oracle::Scene& mesh);

// Whether every edge of the welded mesh is run along as often forwards as backwards: a surface without a border, all of whose
// triangles face the same side of it. It may cross itself.
bool is_closed(const oracle::Scene& mesh);

// Whether a welded closed mesh is the surface of one convex body: all neighbours lie on the same side of their triangles, and
// the surface is that of a ball by Euler's formula. Decided exactly.
bool is_convex(const oracle::Scene& mesh);

// How often the surface winds around a point: the sum of its triangles' solid angles over 4 pi. An integer for closed
// meshes, up to rounding, except for points on the surface. From a point with a winding number other than 0 every ray has to
// hit, as far away it is 0; and each crossing changes it by one.
double winding_number(const oracle::Scene& mesh, const Vec3& point);

struct InsidePoint {
    Vec3 point;
    bool odd; // of its winding number, and so of the crossings of each ray from there
};

// Points with a winding number other than 0, the middle of the box first when it is one; may find none.
std::vector<InsidePoint> inside_points(const oracle::Scene& mesh, std::size_t wanted, Random& random);

} // namespace raywise::sweep
