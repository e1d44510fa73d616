// Rays that the tests of batches share.
#pragma once

#include "batch/ray_arrays.h"
#include "ray/ray.h"

#include <cstddef>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

namespace raywise::testing {

inline const Box unit_box{Vec3(-1.0), Vec3(1.0)};

inline std::vector<Ray> random_rays(std::size_t count, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto vector = [&] { return Vec3(uniform(engine), uniform(engine), uniform(engine)); };
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.origin = 2.0 * vector();
        ray.direction = vector();
    }
    return rays;
}

// Row by row, through the middle of unit_box.
inline std::vector<Ray> camera_rays(int width, int height) {
    std::vector<Ray> rays;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Ray ray;
            ray.origin = Vec3(0.0, 0.0, -5.0);
            ray.direction = Vec3(0.4 * x / width - 0.2, 0.1 * y / height - 0.05, 1.0);
            rays.push_back(ray);
        }
    }
    return rays;
}

inline std::vector<Ray> rays_of_any_numbers(std::size_t count) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double values[] = {0.0, -0.0, 1.0, -1.0, 1e-320, 1e308, -1e308, infinity, -infinity, nan};
    std::mt19937 engine(4);
    std::uniform_int_distribution<std::size_t> pick(0, std::size(values) - 1);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = values[pick(engine)];
            ray.direction[axis] = values[pick(engine)];
        }
        ray.tmin = values[pick(engine)];
        ray.tmax = values[pick(engine)];
    }
    return rays;
}

// Rounded to float32.
inline std::vector<RayF> narrowed(const std::vector<Ray>& rays) {
    std::vector<RayF> narrow;
    for (const Ray& ray : rays) {
        narrow.push_back({glm::vec3(ray.origin), static_cast<float>(ray.tmin), glm::vec3(ray.direction),
                          static_cast<float>(ray.tmax)});
    }
    return narrow;
}

template <class T>
RayArrays arrays_of(const std::vector<CallerRay<T>>& rays) {
    using AnyRay = CallerRay<T>;
    const auto field = [&](auto AnyRay::*member) {
        return StridedArray{reinterpret_cast<const std::byte*>(&(rays.data()->*member)), sizeof(AnyRay), sizeof(T),
                            sizeof(T) == 4 ? Scalar::float32 : Scalar::float64};
    };
    return {rays.size(),          field(&AnyRay::origin), field(&AnyRay::direction),
            field(&AnyRay::tmin), field(&AnyRay::tmax),   {}};
}

} // namespace raywise::testing
