#include "scene/sample_rays.h"

#include "base/split_mix.h"

#include <cmath>
#include <cstdint>

namespace raywise {
namespace {

class Random {
public:
    double operator()() { // in [0, 1)
        state_ += split_mix_step;
        return unit_number(split_mix(state_));
    }

private:
    std::uint64_t state_ = 1;
};

constexpr double two_pi = 6.283185307179586;

Vec3 on_unit_sphere(Random& random) {
    const double z = 2.0 * random() - 1.0;
    const double angle = two_pi * random();
    const double radius = std::sqrt(std::fmax(0.0, 1.0 - z * z));
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

struct SurfacePoint {
    Vec3 position;
    Vec3 normal;
};

SurfacePoint on_surface(const Primitives& primitives, Random& random) {
    std::uint32_t primitive = 0;
    do {
        primitive = static_cast<std::uint32_t>(random() * primitives.count());
    } while (!primitives.is_hittable(primitive));
    const Corners c = primitives.corners(primitive);
    const double root = std::sqrt(random());
    const double v = random() * root;
    return {(1.0 - root) * c[0] + (root - v) * c[1] + v * c[2], unit_normal(c)};
}

} // namespace

std::vector<Ray> make_sample_rays(const Primitives& primitives, RayKind kind, const std::optional<ViewFrame>& view) {
    std::vector<Ray> rays;
    if (primitives.hittable_count() == 0) return rays;
    rays.reserve(sample_limit);

    Random random;
    const Box& bounds = primitives.bounds();
    const Vec3 center = bounds.center();
    const double radius = 0.5 * glm::length(bounds.size());
    const Vec3 outside = center + 2.5 * radius * glm::normalize(Vec3(0.6, 0.7, 0.4));
    const bool from_direction = view && view->kind == ViewFrame::Kind::direction;
    const Vec3 eye = view && !from_direction ? view->origin : outside;

    for (std::size_t i = 0; i < sample_limit; ++i) {
        Ray ray;
        if (from_direction) {
            ray.direction = view->direction;
            ray.origin = on_surface(primitives, random).position -
                         view->direction * (2.0 * radius / glm::length(view->direction));
        } else if (kind == RayKind::camera) {
            ray.origin = eye;
            ray.direction = on_surface(primitives, random).position - eye;
        } else if (kind == RayKind::shadow) {
            const SurfacePoint point = on_surface(primitives, random);
            ray.origin = point.position;
            ray.direction = eye - point.position;
            ray.tmin = 1e-6;
            ray.tmax = 1.0;
        } else if (kind == RayKind::diffuse) {
            const SurfacePoint point = on_surface(primitives, random);
            ray.origin = point.position;
            // A unit vector added to the normal: cosine-weighted around it.
            ray.direction = point.normal + 0.999 * on_unit_sphere(random);
            ray.tmin = 1e-6 * radius;
        } else {
            ray.origin = center + radius * on_unit_sphere(random);
            ray.direction = center + radius * on_unit_sphere(random) - ray.origin;
        }
        rays.push_back(ray);
    }
    return rays;
}

} // namespace raywise
