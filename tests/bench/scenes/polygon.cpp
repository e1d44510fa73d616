#include "bench/scenes/polygon.h"

#include <numeric>

namespace raywise::bench {
namespace {

// Twice the vector area (Newell): square to the polygon's plane, whichever of its corners are concave.
Vec3 normal_of(const std::vector<Vec3>& corners) {
    Vec3 sum(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) sum += glm::cross(corners[i], corners[(i + 1) % corners.size()]);
    return sum;
}

// Positive when a, b, c turn the way the polygon does.
double turn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
    return glm::dot(glm::cross(b - a, c - a), normal);
}

} // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<Vec3>& corners) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const Vec3 normal = normal_of(corners);
    std::vector<std::uint32_t> left(corners.size());
    std::iota(left.begin(), left.end(), 0u);
    const auto is_ear = [&](std::size_t k) {
        const std::uint32_t a = left[(k + left.size() - 1) % left.size()], b = left[k], c = left[(k + 1) % left.size()];
        if (turn(corners[a], corners[b], corners[c], normal) <= 0.0) return false;
        for (const std::uint32_t other : left) {
            if (other == a || other == b || other == c) continue;
            const Vec3& p = corners[other];
            if (turn(corners[a], corners[b], p, normal) >= 0.0 && turn(corners[b], corners[c], p, normal) >= 0.0 &&
                turn(corners[c], corners[a], p, normal) >= 0.0)
                return false;
        }
        return true;
    };
    while (left.size() > 3) {
        std::size_t ear = 0;
        while (ear < left.size() && !is_ear(ear)) ++ear;
        // Corners that lie on one line leave no ear; any will do then.
        if (ear == left.size()) ear = 0;
        triangles.push_back({left[(ear + left.size() - 1) % left.size()], left[ear], left[(ear + 1) % left.size()]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    if (left.size() == 3) triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

} // namespace raywise::bench
