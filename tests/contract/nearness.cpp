#include "contract/nearness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raywise::contract {
namespace {

double distance_to_edge(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double part = std::clamp(glm::dot(point - a, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::length(point - (a + part * along));
}

} // namespace

double distance(const Vec3& point, const Vec3 (&corners)[3]) {
    const auto& [a, b, c] = corners;
    const Vec3 cross = glm::cross(b - a, c - a);
    const double length = glm::length(cross);
    if (!(length > 0.0)) return std::numeric_limits<double>::infinity();
    const Vec3 normal = cross / length;
    // Above the inside the plane is nearest, elsewhere an edge.
    const auto inside = [&](const Vec3& p, const Vec3& q) {
        return glm::dot(glm::cross(q - p, point - p), normal) >= 0.0;
    };
    if (inside(a, b) && inside(b, c) && inside(c, a)) return std::fabs(glm::dot(point - a, normal));
    return std::min({distance_to_edge(point, a, b), distance_to_edge(point, b, c), distance_to_edge(point, c, a)});
}

} // namespace raywise::contract
