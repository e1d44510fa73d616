// Polygons in space cut into triangles of their own corners.
#pragma once

#include "geometry/ear_clipping.h"

#include <vector>

namespace raywise {

// The polygon is cut as it is seen in a coordinate plane (polygon_plane.h), which for a plane polygon is as good as its own.
//
// - A convex polygon becomes the fan about its first corner, (0, 1, 2), (0, 2, 3) and so on. (One that is not plane, and whose fan
//   would have a triangle upright to the plane, is cut as others are.)
// - Any other one is cut ear by ear (ear_clipping.h): corners are looked at in the order 1, 2, ... n - 1, 0, and cut off where they
//   are ears; then those next to a cut, in the order of the cuts, and so on.
//
// There are always n - 2 triangles, each with its corners in the order of the polygon, beginning with the lowest. Those with area
// in the plane are seen the same way round as the polygon and cover its inside once, and nothing else, unless its outline crosses
// itself there or has no inside. Then they are still triangles of its corners, so nothing lies outside of its convex hull, and
// their signed areas in the plane add up to that of the polygon.
class PolygonTriangles {
public:
    // Positions in `corners`, of which there are at least three, all finite; until the next call.
    const std::vector<CornerTriple>& cut(const std::vector<Vec3>& corners);

private:
    bool is_convex();
    bool is_fan(const std::vector<Vec3>& corners) const;

    std::vector<Vec2> points_;
    std::vector<Vec2> outline_; // without repeated points
    EarClipping ears_;
    std::vector<CornerTriple> triangles_;
};

} // namespace raywise
