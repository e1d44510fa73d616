#include "geometry/polygon_triangles.h"

#include "geometry/polygon_plane.h"

namespace raywise {
namespace {

bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto projected = [&](const Vec3& p) { return Vec2(at(p, axis), at(p, (axis + 1) % 3)); };
        if (orientation(projected(a), projected(b), projected(c)) != 0) return true;
    }
    return false;
}

} // namespace

const std::vector<CornerTriple>& PolygonTriangles::cut(const std::vector<Vec3>& corners) {
    triangles_.clear();
    const auto count = static_cast<std::uint32_t>(corners.size());
    if (count > 3) project_polygon(corners, points_);
    if (count == 3 || (is_convex() && is_fan(corners))) {
        for (std::uint32_t i = 2; i < count; ++i) triangles_.push_back({0, i - 1, i});
    } else {
        ears_.cut(points_, triangles_);
    }
    return triangles_;
}

// No turn to the right, and one time round: the direction changes from left to right and back once (Schorn and Fisher 1994,
// "Testing the Convexity of a Polygon").
bool PolygonTriangles::is_convex() {
    outline_.clear();
    for (const Vec2& p : points_) {
        if (outline_.empty() || p != outline_.back()) outline_.push_back(p);
    }
    while (outline_.size() > 1 && outline_.back() == outline_.front()) outline_.pop_back();
    const std::size_t count = outline_.size();
    if (count < 3) return false;
    int changes = 0;
    const Vec2* before = &outline_[count - 2];
    const Vec2* point = &outline_[count - 1];
    for (const Vec2& after : outline_) {
        if (orientation(*before, *point, after) < 0) return false;
        if (precedes(*before, *point) != precedes(*point, after) && ++changes > 2) return false;
        before = point;
        point = &after;
    }
    return true;
}

// Whether triangles of a convex polygon's fan that have no area in the plane have none in space.
bool PolygonTriangles::is_fan(const std::vector<Vec3>& corners) const {
    for (std::size_t i = 2; i < corners.size(); ++i) {
        if (orientation(points_[0], points_[i - 1], points_[i]) == 0 &&
            has_area(corners[0], corners[i - 1], corners[i]))
            return false;
    }
    return true;
}

} // namespace raywise
