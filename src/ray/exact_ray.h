// A ray as the decisive test sees it, in float64: sheared onto its major axis (Woop, Benthin, Wald 2013, "Watertight Ray/Triangle
// Intersection", section 3.1).
#pragma once

#include "ray/direction_scale.h"
#include "ray/ray.h"

#include <cmath>
#include <limits>

namespace raywise {

// The axis of the largest component, the lowest of equals, and its magnitude.
struct MajorAxis {
    int axis;
    double magnitude;

    explicit MajorAxis(const Vec3& direction) {
        const Vec3 magnitude_of = magnitudes(direction);
        const double larger_of_xy = larger(magnitude_of.x, magnitude_of.y);
        // By arithmetic: no branch could be foreseen.
        const auto is_z = static_cast<unsigned>(magnitude_of.z > larger_of_xy);
        const auto is_y = static_cast<unsigned>(magnitude_of.y > magnitude_of.x);
        axis = static_cast<int>(2 * is_z | (is_y & ~is_z));
        magnitude = larger(larger_of_xy, magnitude_of.z);
    }
};

// Components of the direction below 2^-500 of the largest (rounded down to a power of two) count as zero: their products with
// coordinates would leave the range of float64, and with them exactness.
struct ExactRay {
    static constexpr double smallest_direction = 0x1p-500;

    // ray: traceable.
    explicit ExactRay(const Ray& ray) : ExactRay(ray, 0.0) {}
    // length: of the direction, where its DirectionScale was found before; else 0.
    ExactRay(const Ray& ray, double length) : origin(ray.origin), tmin(ray.tmin), tmax(ray.tmax) {
        const MajorAxis major(ray.direction);
        major_axis = major.axis;
        // The next axis and the one after it, from a word with two bits for each.
        x_axis = 0b00'10'01 >> 2 * major_axis & 3;
        y_axis = 0b01'00'10 >> 2 * major_axis & 3;
        scale = length != 0.0 ? DirectionScale::of_length(length) : DirectionScale(major.magnitude);
        if (scale.is_normal()) {
            direction = ray.direction * scale.inverse_length();
        } else {
            for (int axis = 0; axis < 3; ++axis) direction[axis] = scale.to_caller(ray.direction[axis]);
        }
        const Vec3 magnitude = magnitudes(direction);
        if (smaller(magnitude.x, smaller(magnitude.y, magnitude.z)) < smallest_direction) {
            for (int axis = 0; axis < 3; ++axis) {
                if (magnitude[axis] < smallest_direction) direction[axis] = std::copysign(0.0, direction[axis]);
            }
        }
        inverse_major = 1.0 / at(direction, major_axis);
        shear_x = at(direction, x_axis) * inverse_major;
        shear_y = at(direction, y_axis) * inverse_major;
        axis_origin = {at(origin, x_axis), at(origin, y_axis), at(origin, major_axis)};
        scaled_tmin = scale.from_caller(tmin);
    }

    // The t of a hit at scaled t, as the caller sees it; never a negative zero.
    double caller_t(double scaled_t) const { return scale.to_caller(scaled_t) + 0.0; }
    // A t that overflows in the caller's unit cannot be told.
    bool contains(double t) const { return tmin <= t && t <= tmax && t <= std::numeric_limits<double>::max(); }

    Vec3 origin;
    Vec3 direction; // largest component in [1, 2)
    double tmin;    // in the caller's unit
    double tmax;
    double scaled_tmin;
    DirectionScale scale;
    int major_axis; // of the largest direction component
    int x_axis;     // the other two, so that (x, y, major) is a cyclic order
    int y_axis;
    double inverse_major; // 1 / direction[major_axis]
    double shear_x;       // direction[x_axis] / direction[major_axis]
    double shear_y;
    Vec3 axis_origin; // the origin's components in the order x_axis, y_axis, major_axis
};

} // namespace raywise
