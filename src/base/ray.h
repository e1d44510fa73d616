// Rays, as the caller gives them and as the structures use them, and the conservative ray-box test.
#pragma once

#include "base/box.h"
#include "base/skip_list.h"
#include "base/vec.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace raywise {

struct Ray {
    Vec3 origin{0.0};
    double tmin = 0.0;
    Vec3 direction{0.0};
    double tmax = std::numeric_limits<double>::infinity();

    bool has_nan() const {
        const auto any_nan = [](const Vec3& v) { return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z); };
        return any_nan(origin) || any_nan(direction) || std::isnan(tmin) || std::isnan(tmax);
    }
};

// The unit in which t is counted inside the library ("scaled t"): directions are scaled by a power of two so that their largest
// component lies in [1, 2), which makes one error bound serve all rays and keeps products of tiny or huge directions from under- or
// overflowing. Both conversions are exact, but for results beyond the normal numbers.
class RayUnit {
public:
    RayUnit() = default;
    // largest: of the magnitudes of the caller's direction; finite, not zero.
    explicit RayUnit(double largest) {
        std::uint64_t bits;
        std::memcpy(&bits, &largest, sizeof bits);
        exponent_ = static_cast<int>(bits >> 52) - 1023; // of a normal number
        if (std::abs(exponent_) <= 1000) {               // so that 2^exponent and 2^-exponent are normal numbers both
            unit_ = power_of_two(exponent_);
            inverse_unit_ = power_of_two(-exponent_);
        } else {
            exponent_ = std::ilogb(largest);
        }
    }

    // By multiplication where a power of two can be multiplied with: ldexp takes ten times as long.
    double to_caller(double scaled_t) const {
        return is_plain() ? scaled_t * inverse_unit_ : std::ldexp(scaled_t, -exponent_);
    }
    double from_caller(double t) const { return is_plain() ? t * unit_ : std::ldexp(t, exponent_); }

    int exponent() const { return exponent_; } // of the unit
    bool is_plain() const { return unit_ != 0.0; }
    double unit() const { return unit_; }                 // where it is plain
    double inverse_unit() const { return inverse_unit_; } // where it is plain

private:
    static double power_of_two(int exponent) {
        const auto bits = static_cast<std::uint64_t>(exponent + 1023) << 52;
        double power;
        std::memcpy(&power, &bits, sizeof power);
        return power;
    }

    int exponent_ = 0;
    double unit_ = 0.0; // 0: not a normal number, or its inverse is not
    double inverse_unit_ = 0.0;
};

// The axis of the largest component, the lowest of equals, and its magnitude.
struct MajorAxis {
    int axis;
    double magnitude;

    explicit MajorAxis(const Vec3& direction) {
        const Vec3 magnitude_of = magnitudes(direction);
        const double larger_of_xy = larger(magnitude_of.x, magnitude_of.y);
        axis = magnitude_of.z > larger_of_xy ? 2 : static_cast<int>(magnitude_of.y > magnitude_of.x);
        magnitude = larger(larger_of_xy, magnitude_of.z);
    }
};

// A ray made ready for traversal.
//
// The direction is scaled, and t counted, in a RayUnit.
//
// `margin` is the slack every culling test must leave, in scaled t. A hit's t is accurate to margin / 8 (see
// geometry/triangle_test.h) and the slab distances of boxes the ray meets within the scene are too, so a test that errs
// by `margin` towards visiting can never lose a hit that another structure finds.
//
// Components of the direction below 2^-500 of the largest (rounded down to a power of two) count as zero: their products with coordinates would leave the range
// of float64, and with them exactness; 1 / direction stays finite or is infinite for a true zero.
class PreparedRay {
public:
    static constexpr double smallest_direction = 0x1p-500;

    // bounds: of the whole scene. The ray has to be valid (see is_traceable).
    PreparedRay(const Ray& ray, const Box& bounds, SkipList skipped = {}) : origin(ray.origin), skip(skipped) {
        const MajorAxis major(ray.direction);
        major_axis = major.axis;
        unit_ = RayUnit(major.magnitude);
        for (int axis = 0; axis < 3; ++axis) {
            direction[axis] = to_caller(ray.direction[axis]);
            if (std::fabs(direction[axis]) < smallest_direction) direction[axis] = std::copysign(0.0, direction[axis]);
            inverse[axis] = 1.0 / direction[axis];
        }
        x_axis = major_axis == 2 ? 0 : major_axis + 1;
        y_axis = x_axis == 2 ? 0 : x_axis + 1;
        shear_x = direction[x_axis] * inverse[major_axis];
        shear_y = direction[y_axis] * inverse[major_axis];
        tmin = from_caller(ray.tmin);
        // Converting rounds only where the result is below the normal numbers; then the interval must not grow.
        if (to_caller(tmin) < ray.tmin) tmin = std::nextafter(tmin, std::numeric_limits<double>::infinity());
        // A hit so far away that its t overflows in the caller's unit cannot be reported.
        tmax = smaller(from_caller(ray.tmax), from_caller(std::numeric_limits<double>::max()));
        if (to_caller(tmax) > ray.tmax) tmax = std::nextafter(tmax, -std::numeric_limits<double>::infinity());
        const double reach =
            max_component(larger(magnitudes(bounds.lower - origin), magnitudes(bounds.upper - origin)));
        margin = 0x1p-34 * larger(reach, 0x1p-900);
        // A direction so long that the caller's t is below the normal numbers rounds t to steps that may be large here. For others
        // this would only cost the time that processors take for a product with such a number.
        if (unit_.exponent() > 100)
            margin = std::max(margin, 16.0 * from_caller(std::numeric_limits<double>::denorm_min()));
        certain_edge =
            reach > 0x1p-370 && reach < 0x1p400 ? 0x1p-43 * reach * reach : std::numeric_limits<double>::infinity();
        axis_origin = {at(origin, x_axis), at(origin, y_axis), at(origin, major_axis)};
    }

    // A ray that can hit something at all: no NaN, finite origin and direction, direction not zero, interval not inverted.
    static bool is_traceable(const Ray& ray) {
        return is_finite(ray.origin) && is_finite(ray.direction) && ray.direction != Vec3(0.0) && ray.tmin <= ray.tmax;
    }

    double to_caller(double scaled_t) const { return unit_.to_caller(scaled_t); }
    double from_caller(double t) const { return unit_.from_caller(t); }

    Vec3 origin;
    Vec3 direction; // largest component in [1, 2)
    Vec3 inverse;   // 1 / direction; infinite where the direction is zero
    double tmin;    // scaled
    double tmax;    // scaled
    double margin;  // scaled
    int major_axis; // of the largest direction component
    int x_axis;     // the other two, so that (x, y, major) is a cyclic order
    int y_axis;
    double shear_x; // direction[x_axis] / direction[major_axis]
    double shear_y;
    Vec3 axis_origin; // the origin's components in the order x_axis, y_axis, major_axis
    // An edge value of the triangle test beyond this has the right sign, whatever the triangle: see geometry/triangle_test.h.
    // Infinite where products of coordinates might leave the range of float64.
    double certain_edge;
    SkipList skip; // what the ray does not see

private:
    RayUnit unit_;
};

// A traceable ray as the caller gave it, with what it takes to prepare it: for structures that answer many rays without.
struct UnpreparedRay {
    const Ray& ray;
    const Box& bounds; // of the whole scene
    SkipList skip;

    PreparedRay prepare() const { return {ray, bounds, skip}; }
};

// The part of the ray inside a box, in scaled t.
struct Interval {
    double near;
    double far;
};

// Slab test (Kay and Kajiya 1986), with the box wider by 2^-50 of the ray's reach on every side: as much as its coordinates
// relative to the origin may be rounded by, which an axis with a tiny or zero direction would multiply without bound. Where the
// direction is zero the products are infinite or NaN; the comparisons are written so that a NaN leaves the interval as it is.
template <class BoxType>
inline Interval box_interval(const PreparedRay& ray, const BoxType& box) {
    const double slack = 0x1p-16 * ray.margin;
    double near = -std::numeric_limits<double>::infinity();
    double far = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double lower = (static_cast<double>(at(box.lower, axis)) - at(ray.origin, axis)) - slack;
        const double upper = (static_cast<double>(at(box.upper, axis)) - at(ray.origin, axis)) + slack;
        const double inverse = at(ray.inverse, axis);
        const double a = lower * inverse;
        const double b = upper * inverse;
        const bool backwards = std::signbit(inverse);
        const double entry = backwards ? b : a;
        const double exit = backwards ? a : b;
        near = entry > near ? entry : near;
        far = exit < far ? exit : far;
    }
    return {near, far};
}

// Whether a box may hold a hit at scaled t in [ray.tmin, limit]; errs towards yes by the ray's margin. The entry distance
// goes to `near`.
template <class BoxType>
inline bool may_hit_box(const PreparedRay& ray, const BoxType& box, double limit, double& near) {
    const Interval interval = box_interval(ray, box);
    near = interval.near;
    return interval.near <= interval.far + ray.margin && interval.near <= limit + ray.margin &&
           interval.far >= ray.tmin - ray.margin;
}

} // namespace raywise
