#include "geometry/triangle_box_overlap.h"

#include "base/vec.h"

#include <algorithm>
#include <cmath>

namespace raywise {

CellRange bounding_cells(const Corners& triangle, const std::array<std::uint32_t, 3>& resolution) {
    CellRange range;
    const Vec3 lower = glm::min(triangle[0], glm::min(triangle[1], triangle[2])) - Vec3(overlap_slack);
    const Vec3 upper = glm::max(triangle[0], glm::max(triangle[1], triangle[2])) + Vec3(overlap_slack);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const double last = resolution[a] - 1.0;
        // Conversion cuts off like floor, as nothing is negative.
        range.lower[a] = static_cast<std::int32_t>(std::clamp(lower[axis], 0.0, last));
        range.upper[a] = static_cast<std::int32_t>(std::clamp(upper[axis], 0.0, last));
    }
    return range;
}

TriangleCellTest::TriangleCellTest(const Corners& triangle, const std::array<std::int32_t, 3>& base, int flat_axis) {
    const Vec3 origin(base[0], base[1], base[2]);
    const Corners v = {triangle[0] - origin, triangle[1] - origin, triangle[2] - origin};
    const Vec3 e[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};

    for (int axis = 0; axis < 3; ++axis) {
        if (flat_axis >= 0 && axis != flat_axis) continue;
        const int ax = axis == 2 ? 0 : axis + 1;
        const int ay = ax == 2 ? 0 : ax + 1;
        for (int edge = 0; edge < 3; ++edge) {
            // The normal of the edge in the plane, and where it puts the triangle: the edge itself is one point, the
            // opposite corner the other. Which side is inside does not matter, so a projection that rounding turns
            // over does no harm.
            const double x = -e[edge][ay];
            const double y = e[edge][ax];
            const Vec3& on = v[static_cast<std::size_t>(edge)];
            const Vec3& off = v[static_cast<std::size_t>((edge + 2) % 3)];
            const double a = x * on[ax] + y * on[ay];
            const double b = x * off[ax] + y * off[ay];
            const double slack = overlap_slack * (std::fabs(x) + std::fabs(y));
            // The unit square of cell (0, 0) covers [low, high].
            const double low = std::min(x, 0.0) + std::min(y, 0.0);
            const double high = std::max(x, 0.0) + std::max(y, 0.0);
            edges_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(edge)] = {
                x, y, std::min(a, b) - high - slack, std::max(a, b) - low + slack};
        }
    }

    if (flat_axis >= 0) return;
    normal_ = glm::cross(e[0], e[1]);
    const double position = glm::dot(normal_, v[0]);
    const double high = std::max(normal_.x, 0.0) + std::max(normal_.y, 0.0) + std::max(normal_.z, 0.0);
    const double low = std::min(normal_.x, 0.0) + std::min(normal_.y, 0.0) + std::min(normal_.z, 0.0);
    // The normal of a sliver may be little more than rounding, up to 2^-51 of the square of its length along each
    // axis. Times the distance of a cell's corner that can be more than the slack, so it counts by itself.
    const double length = max_component(glm::max(glm::abs(e[0]), glm::max(glm::abs(e[1]), glm::abs(e[2]))));
    const double rounding = 0x1p-47 * length * length * (length + 2.0);
    const double slack = overlap_slack * (high - low) + rounding;
    plane_lower_ = position - high - slack;
    plane_upper_ = position - low + slack;
}

Vec3 ClippedTriangle::crossing(const Vec3& a, const Vec3& b, int axis, double position) {
    // Each difference is of two given numbers, so it is right to the last place, and the weight too.
    Vec3 p = a + (b - a) * ((position - a[axis]) / (b[axis] - a[axis]));
    p[axis] = position;
    return p;
}

SideBoxes ClippedTriangle::boxes_of_sides(int axis, double below_to, double above_from) const {
    SideBoxes boxes;
    for (std::size_t i = 0; i < count_; ++i) {
        const Vec3& a = points_[i];
        const Vec3& b = points_[i + 1 == count_ ? 0 : i + 1];
        if (a[axis] <= below_to) boxes.below.extend(a);
        if (a[axis] >= above_from) boxes.above.extend(a);
        if ((a[axis] < below_to) != (b[axis] < below_to)) boxes.below.extend(crossing(a, b, axis, below_to));
        if ((a[axis] < above_from) != (b[axis] < above_from)) boxes.above.extend(crossing(a, b, axis, above_from));
    }
    return boxes;
}

void ClippedTriangle::cut(int axis, double position, double sign) {
    bool all_inside = true;
    for (std::size_t i = 0; i < count_; ++i) all_inside = all_inside && sign * (points_[i][axis] - position) >= 0.0;
    if (all_inside) return;

    std::array<Vec3, 9> kept;
    std::size_t kept_count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        const Vec3& a = points_[i];
        const Vec3& b = points_[i + 1 == count_ ? 0 : i + 1];
        const double at_a = sign * (a[axis] - position);
        const double at_b = sign * (b[axis] - position);
        if (at_a >= 0.0) kept[kept_count++] = a;
        if ((at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0))
            kept[kept_count++] = crossing(a, b, axis, position);
    }
    points_ = kept;
    count_ = kept_count;
}

std::array<double, 2> ClippedTriangle::extent(int axis) const {
    std::array<double, 2> result{points_[0][axis], points_[0][axis]};
    for (std::size_t i = 1; i < count_; ++i) {
        result[0] = std::min(result[0], points_[i][axis]);
        result[1] = std::max(result[1], points_[i][axis]);
    }
    return result;
}

} // namespace raywise
