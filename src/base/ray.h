// Rays, as the caller gives them and as the structures use them, and the conservative ray-box test.
#pragma once

#include "base/box.h"
#include "base/skip_list.h"
#include "base/vec.h"

#include <algorithm>
#include <cmath>
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

// A ray made ready for traversal.
//
// The direction is scaled by a power of two so that its largest component lies in [1, 2); t inside the library is
// counted in that unit ("scaled t"), and to_caller() and from_caller() convert without rounding. Scaling makes one error
// bound serve all rays and keeps products of tiny or huge directions from under- or overflowing.
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
        const Vec3 magnitude = glm::abs(ray.direction);
        major_axis =
            magnitude.x >= magnitude.y ? (magnitude.x >= magnitude.z ? 0 : 2) : (magnitude.y >= magnitude.z ? 1 : 2);
        scale_exponent_ = std::ilogb(at(magnitude, major_axis));
        const bool plain = std::abs(scale_exponent_) <= 1000; // 2^exponent and 2^-exponent are both normal numbers
        unit_ = plain ? std::ldexp(1.0, scale_exponent_) : 0.0;
        inverse_unit_ = plain ? 1.0 / unit_ : 0.0;
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
        tmax = std::min(from_caller(ray.tmax), from_caller(std::numeric_limits<double>::max()));
        if (to_caller(tmax) > ray.tmax) tmax = std::nextafter(tmax, -std::numeric_limits<double>::infinity());
        const double reach = max_component(glm::max(glm::abs(bounds.lower - origin), glm::abs(bounds.upper - origin)));
        // A direction so long that the caller's t is below the normal numbers rounds t to steps that may be large here.
        const double t_step = from_caller(std::numeric_limits<double>::denorm_min());
        margin = std::max(0x1p-34 * std::max(reach, 0x1p-900), 16.0 * t_step);
        certain_edge =
            reach > 0x1p-370 && reach < 0x1p400 ? 0x1p-43 * reach * reach : std::numeric_limits<double>::infinity();
        axis_origin = {at(origin, x_axis), at(origin, y_axis), at(origin, major_axis)};
    }

    // A ray that can hit something at all: no NaN, finite origin and direction, direction not zero, interval not inverted.
    static bool is_traceable(const Ray& ray) {
        return is_finite(ray.origin) && is_finite(ray.direction) && ray.direction != Vec3(0.0) && ray.tmin <= ray.tmax;
    }

    // By multiplication where a power of two can be multiplied with: ldexp takes ten times as long.
    double to_caller(double scaled_t) const {
        return unit_ != 0.0 ? scaled_t * inverse_unit_ : std::ldexp(scaled_t, -scale_exponent_);
    }
    double from_caller(double t) const { return unit_ != 0.0 ? t * unit_ : std::ldexp(t, scale_exponent_); }

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
    int scale_exponent_;
    double unit_;         // 2^scale_exponent_; 0 when that is no normal number
    double inverse_unit_; // 2^-scale_exponent_
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
