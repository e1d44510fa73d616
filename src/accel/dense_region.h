// Where most triangles are: what lies far off must not decide about how precisely the rest is seen.
#pragma once

#include "geometry/primitives.h"
#include "ray/scene_frame.h"

#include <vector>

namespace raywise {

// The median of the triangles' middles along each axis, how far around it four fifths of them lie, along any axis, and the median of their
// largest extents.
struct DenseRegion {
    Vec3 center{0.0};
    double radius = 0.0;
    double extent = 0.0;
};

// Of a sample of the primitives that can be hit; some microseconds.
DenseRegion dense_region(const Primitives& primitives);

// How far a scene reaches, and where some of it is.
struct SceneExtent {
    Box bounds;
    double largest_extent = 0.0; // of a primitive, along any axis
    std::vector<Vec3> middles;   // of a sample of primitives

    // How near a tenth of the primitives is to a point, along every axis; infinite where there are none.
    double near_distance(const Vec3& point) const;
};
SceneExtent scene_extent(const Primitives& primitives);

// The frame of a scene in which something can be hit. dense: its dense region.
SceneFrame scene_frame(const Primitives& primitives, const DenseRegion& dense);
SceneFrame scene_frame(const Primitives& primitives);

} // namespace raywise
