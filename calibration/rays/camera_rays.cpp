// A pinhole camera: rays through the centres of the pixels, row by row.
#include "rays/rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raywise::workloads {
namespace {

// tan(x) by its continued fraction: the same bits everywhere, and good to 1e-9 up to a radian.
double tangent(double x) {
    const double s = x * x;
    return x / (1.0 - s / (3.0 - s / (5.0 - s / (7.0 - s / (9.0 - s / 11.0)))));
}

Vec3 unit(const Vec3& v) { return v / std::sqrt(glm::dot(v, v)); }

} // namespace

Rays camera_rays(const RayRequest& request) {
    Rays rays;
    if (request.count == 0) return rays;
    const Camera camera = camera_of(request.mesh);
    const Vec3 forward = unit(camera.target - camera.eye);
    const Vec3 right = unit(glm::cross(forward, Vec3(0.0, 0.0, 1.0)));
    const Vec3 up = glm::cross(right, forward);

    const double count = static_cast<double>(request.count);
    const auto height = static_cast<std::uint64_t>(std::max(1.0, std::floor(std::sqrt(count * 3.0 / 4.0))));
    const std::uint64_t width = (request.count + height - 1) / height;
    const double half_height = tangent(camera.vertical_angle / 2.0);
    const double pixel = 2.0 * half_height / static_cast<double>(height);
    for (std::uint64_t i = 0; i < request.count; ++i) {
        const double x = static_cast<double>(i % width) + 0.5 - static_cast<double>(width) / 2.0;
        const double y = static_cast<double>(height) / 2.0 - 0.5 - static_cast<double>(i / width);
        rays.add(camera.eye, forward + right * (x * pixel) + up * (y * pixel), 0.0,
                 std::numeric_limits<double>::infinity());
    }
    return rays;
}

} // namespace raywise::workloads
