#include "geometry/triangle_test.h"

#include <limits>

namespace raywise::triangle_test_detail {

double z_near_origin(const ExactRay& ray, const Vec3& a, const Vec3& b, const Vec3& c, bool backwards, double z,
                     double z_error) {
    // z is the side of the plane divided by the sum of the edges.
    const double side = plane_side(ray.origin, a, b, c);
    if (side == 0.0) return 0.0;
    const bool negative = (side < 0.0) != backwards;
    if (negative ? z < 0.0 : z > 0.0) return z;
    // Rounding hid it: as near as float64 tells, and no further away than it can be.
    const double sum = glm::dot(ray.direction, glm::cross(b - a, c - a)) * ray.inverse_major;
    const double estimate = std::fabs(side / sum);
    const double distance = estimate < z_error ? estimate : z_error;
    return std::copysign(std::max(distance, 2.0 * std::numeric_limits<double>::denorm_min()), negative ? -1.0 : 1.0);
}

} // namespace raywise::triangle_test_detail
