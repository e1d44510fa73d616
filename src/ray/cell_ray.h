// A ray as structures see it that divide space at planes in float64 (grid, binary trees): where it starts near them, and what
// its distances may be off by.
//
// Far away float64 does not resolve the scene: 1e11 times its size from it a distance is wrong by 1e-5 of that size. So a ray that
// starts far off is moved along its line to the point nearest to the middle of the bounds, start + s * direction, with one rounding of
// fma: what is lost is 2^-53 of the new start, wherever the old one was. s counts from there: scaled t = moved + s.
//
// What a hit's s and a plane's distance are off by, together, is below margin(s):
// - The distance of a plane, (plane - start) * inverse, rounds by 2^-51 of itself: planes and start are numbers of float64. Where the
//   ray was moved, its start is rounded by 2^-53, which acts like a plane that is as much elsewhere: see plane_error.
// - A triangle's t is a mean of its corners' distances by weights that are good to 2^-28.6 in sum, or its error is below 2^-38 of
//   the distance D of the corner farthest from the origin, whichever is less; and it rounds by 2^-51 D (geometry/triangle_test.h). With E
//   the largest extent of a primitive, D is at most |t| + E. So it is below 2^-36 (|s| + E) where the ray was not moved, and below
//   2^-28 E + 2^-50 (|moved| + |s| + E) where it was. It depends on the primitives' size, the ray and the distance; not on how large
//   the scene is.
#pragma once

#include "base/box.h"
#include "ray/exact_ray.h"

#include <cmath>
#include <limits>

namespace raywise {

// A part of a ray, in s.
struct Interval {
    double near;
    double far;
};

// Finite, so that an end at infinity stays there when an error is taken from it or added.
inline double finite_distance(double t) { return smaller(std::fabs(t), std::numeric_limits<double>::max()); }

// What the t of a hit at scaled t may be off by, for a ray that nobody moved; see above.
inline double hit_error(double t, double largest_extent) {
    const double distance = finite_distance(t);
    return smaller(0x1p-27 * largest_extent, 0x1p-35 * (largest_extent + distance)) + 0x1p-46 * distance;
}

class CellRay {
public:
    // bounds: of the scene, not empty. largest_extent: of any of its primitives along any axis.
    CellRay(const ExactRay& ray, const Box& bounds, double largest_extent)
        : start(ray.origin), direction(ray.direction), scale_(ray.scale) {
        const Vec3 center = bounds.center();
        const double size = max_component(bounds.size());
        base_ = 0x1p-34 * largest_extent;
        const double distance = max_component(magnitudes(start - center));
        if (distance > farthest * size) move(center, distance, size, largest_extent);
        for (int axis = 0; axis < 3; ++axis) inverse[axis] = 1.0 / direction[axis];
        first = lower_end(ray.tmin);
        last = upper_end(ray.tmax);
    }

    double margin(double s) const { return base_ + 0x1p-35 * finite_distance(s); }
    // No hit whose t is at least the caller's t lies before the one, none at or below it behind the other.
    double lower_end(double t) const {
        const double s = scale_.from_caller(t) - moved_;
        return s - margin(s);
    }
    double upper_end(double t) const {
        const double s = scale_.from_caller(t) - moved_;
        return s + margin(s);
    }

    // Where the ray is between two planes across an axis along which it moves, for certain not less.
    Interval slab(int axis, double lower, double upper) const {
        const double a = (lower - start[axis]) * inverse[axis];
        const double b = (upper - start[axis]) * inverse[axis];
        const double near = smaller(a, b) - plane_error[axis];
        const double far = larger(a, b) + plane_error[axis];
        return {near - margin(near), far + margin(far)};
    }
    // Whether planes have an error besides the margin.
    bool is_moved() const { return plane_error != Vec3(0.0); }
    // Whether anything is known of where it passes; elsewhere all has to be tested.
    bool is_known() const { return base_ < std::numeric_limits<double>::infinity(); }

    Vec3 start;     // on the line of the ray
    Vec3 direction; // largest component in [1, 2)
    Vec3 inverse;   // 1 / direction; infinite where the direction is zero
    Vec3 plane_error{
        0.0};     // what distances of planes on each axis may be off by besides; zero where the ray was not moved
    double first; // the s before which no hit lies
    double last;  // the s behind which none does

    // In sizes of the bounds.
    static constexpr double farthest = 4.0;

private:
    // To the point of the line that is nearest to the center.
    void move(const Vec3& center, double distance, double size, double largest_extent);

    DirectionScale scale_;
    double moved_ = 0.0;
    double base_;
};

} // namespace raywise
