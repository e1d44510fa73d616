// Cutting a triangle by a plane across an axis, conservatively and fast.
#pragma once

#include "accel/bvh/build/bounds.h"
#include "geometry/triangle_mesh.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace raywise {

// A triangle in float32, which rounding may have moved.
class CuttableTriangle {
public:
    explicit CuttableTriangle(const Corners& triangle);

    struct Sides {
        Bounds below;
        Bounds above;
    };
    // The boxes of what lies on both sides of the plane at `position`, as far as it is within `part`, a box of this triangle
    // or of some part of it that the plane passes through. Every exact point of the triangle that is in `part` is in one of
    // both.
    RW_INLINE Sides cut(const Bounds& part, int axis, float position) const;

private:
    static RW_INLINE Lanes plane_limit(int axis, float position, float elsewhere) {
        Lanes limit = fill_lanes(elsewhere);
        limit[axis] = position;
        return limit;
    }
    RW_INLINE Bounds clip(const Bounds& side, const Bounds& part) const {
        Bounds clipped{max_lanes(side.lower - slack_, part.lower), min_lanes(side.upper + slack_, part.upper)};
        // The triangle meets the plane outside of the part: nothing is on this side but what has no thickness.
        clipped.lower = min_lanes(clipped.lower, clipped.upper);
        return clipped;
    }

    Lanes corners_[3];
    Lanes slack_;
    bool may_cut_; // false where float32 would not do
};

inline CuttableTriangle::CuttableTriangle(const Corners& triangle) {
    double largest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& p = triangle[i];
        largest = std::max(largest, max_component(glm::abs(p)));
        corners_[i] = Lanes{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0.0f};
    }
    may_cut_ = largest > 0x1p-80 && largest < 0x1p100;
    slack_ = fill_lanes(static_cast<float>(0x1p-19 * largest));
}

// The part of the triangle of rounded corners on one side is the hull of the corners on that side and of the points where
// edges cross the plane. Let M be the largest coordinate. An exact point is within 2^-24 M of the point with the same
// weights in the triangle of rounded corners. A computed crossing is off by less than 2^-20 M: differences, quotient and
// product are right to 2^-24 of themselves, edges are no longer than 2 M along an axis, and the last sum rounds by 2^-23 M.
// So boxes that are 2^-19 M wider, at the plane too, hold the exact points.
inline CuttableTriangle::Sides CuttableTriangle::cut(const Bounds& part, int axis, float position) const {
    if (!may_cut_) return {part, part};
    Bounds below = Bounds::none();
    Bounds above = Bounds::none();
    for (int i = 0; i < 3; ++i) {
        const Lanes a = corners_[i];
        const Lanes b = corners_[i == 2 ? 0 : i + 1];
        const float at_a = a[axis];
        const float at_b = b[axis];
        if (at_a <= position) below.extend({a, a});
        if (at_a >= position) above.extend({a, a});
        if ((at_a < position) != (at_b < position)) {
            const Lanes crossing = a + (b - a) * fill_lanes((position - at_a) / (at_b - at_a));
            below.extend({crossing, crossing});
            above.extend({crossing, crossing});
        }
    }
    below.upper = min_lanes(below.upper, plane_limit(axis, position, std::numeric_limits<float>::infinity()));
    above.lower = max_lanes(above.lower, plane_limit(axis, position, -std::numeric_limits<float>::infinity()));
    return {clip(below, part), clip(above, part)};
}

} // namespace raywise
