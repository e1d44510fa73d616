// A ray as the caller gives it.
#pragma once

#include "base/vec.h"

#include <cmath>
#include <limits>

namespace raywise {

struct Ray {
    Vec3 origin{0.0};
    double tmin = 0.0;
    Vec3 direction{0.0};
    double tmax = std::numeric_limits<double>::infinity();

    // Quick, and true for every ray that has one.
    bool may_have_nan() const {
        const double sum =
            ((origin.x + origin.y) + (origin.z + tmin)) + ((direction.x + direction.y) + (direction.z + tmax));
        return std::isnan(sum);
    }
    bool has_nan() const {
        const auto any_nan = [](const Vec3& v) { return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z); };
        return any_nan(origin) || any_nan(direction) || std::isnan(tmin) || std::isnan(tmax);
    }
    // Whether it can hit anything at all: no NaN, finite origin and direction, direction not zero, interval not inverted.
    bool is_traceable() const {
        return is_finite(origin) && is_finite(direction) && direction != Vec3(0.0) && tmin <= tmax;
    }
};

} // namespace raywise
