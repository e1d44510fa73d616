// Which triangles certainly have area, and how far those reach: what can be said of a mesh without exact arithmetic, at the speed of
// reading it.
#pragma once

#include "base/box.h"
#include "base/page_array.h"
#include "geometry/triangle_mesh.h"

#include <cstdint>

namespace raywise {

// How far triangles reach.
struct Reach {
    Box bounds;
    double largest_extent = 0.0; // no triangle is longer along any axis

    void extend(const Reach& other) {
        bounds.extend(other.bounds);
        largest_extent = larger(largest_extent, other.largest_extent);
    }
};

// Of a mesh's triangles first ... end - 1: appends those that may be invalid or without area to `doubtful`, and extends `reach` by the
// others.
void check_areas(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t end, Reach& reach,
                 PageVector<std::uint32_t>& doubtful);

} // namespace raywise
