// A ray as the caller gives it, of float64 or float32.
#pragma once

#include "base/vec.h"

#include <cmath>
#include <limits>

namespace raywise {

template <class T>
struct CallerRay {
    using Vector = glm::vec<3, T>;

    Vector origin{T(0)};
    T tmin = T(0);
    Vector direction{T(0)};
    T tmax = std::numeric_limits<T>::infinity();

    // Quick, and true for every ray that has one.
    bool may_have_nan() const {
        const T sum =
            ((origin.x + origin.y) + (origin.z + tmin)) + ((direction.x + direction.y) + (direction.z + tmax));
        return std::isnan(sum);
    }
    bool has_nan() const {
        const auto any_nan = [](const Vector& v) { return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z); };
        return any_nan(origin) || any_nan(direction) || std::isnan(tmin) || std::isnan(tmax);
    }
    // Whether it can hit anything at all: no NaN, finite origin and direction, direction not zero, interval not inverted.
    bool is_traceable() const {
        return is_finite(origin) && is_finite(direction) && direction != Vector(T(0)) && tmin <= tmax;
    }
};

using Ray = CallerRay<double>;
using RayF = CallerRay<float>;

// The same ray in float64.
inline const Ray& widened(const Ray& ray) { return ray; }
inline Ray widened(const RayF& ray) { return {Vec3(ray.origin), ray.tmin, Vec3(ray.direction), ray.tmax}; }

} // namespace raywise
