#include "geometry/polygon_plane.h"

#include "geometry/exact.h"
#include "geometry/exact_integers.h"

#include <algorithm>

namespace raywise {
namespace {

struct View {
    int axis;     // to look along
    bool flipped; // from the other side
};

// The index of the largest; of several alike the last.
template <class Value>
int largest(const Value& x, const Value& y, const Value& z) {
    if (z >= x && z >= y) return 2;
    return y >= x ? 1 : 0;
}

// Whether float64 settles the view. Newell's sum of (p - first) x (next - first) over all edges; the sum of magnitudes bounds its
// rounding.
bool approximate_view(const std::vector<Vec3>& corners, View& view) {
    Vec3 normal(0.0);
    Vec3 magnitude(0.0);
    const Vec3& first = corners[0];
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const Vec3 p = corners[i - 1] - first;
        const Vec3 q = corners[i] - first;
        const Vec3 left(p.y * q.z, p.z * q.x, p.x * q.y);
        const Vec3 right(p.z * q.y, p.x * q.z, p.y * q.x);
        normal += left - right;
        magnitude += magnitudes(left) + magnitudes(right);
    }
    if (!is_finite(normal)) return false;
    const Vec3 size = magnitudes(normal);
    view.axis = largest(size.x, size.y, size.z);
    view.flipped = at(normal, view.axis) < 0.0;
    // A product rounds by 3 * 2^-53 of itself, each of as many sums as corners by 2^-53 of at most `magnitude`.
    const double bound = 0x1p-52 * (static_cast<double>(corners.size()) + 4.0) * at(magnitude, view.axis);
    return at(magnitude, view.axis) > 0x1p-900 && at(size, view.axis) > bound;
}

// Whether the normal is not exactly zero.
bool exact_view(const std::vector<Vec3>& corners, View& view) {
    const BinaryUnit length(corners.begin(), corners.end());
    const WideVec3 first = length.count(corners[0]);
    WideVec3 normal{};
    WideVec3 p{};
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const WideVec3 q = length.count(corners[i]) - first;
        normal = normal + cross(p, q);
        p = q;
    }
    const WideInteger* components[] = {&normal.x, &normal.y, &normal.z};
    view.axis = largest<WideInteger>(abs(normal.x), abs(normal.y), abs(normal.z));
    view.flipped = components[view.axis]->sign() < 0;
    return !components[view.axis]->is_zero();
}

// That of the first corner and the first two others that make a triangle with it. False where all are in line.
bool view_of_first_triangle(const std::vector<Vec3>& corners, View& view) {
    const Vec3& first = corners[0];
    const auto other = std::find_if(corners.begin(), corners.end(), [&](const Vec3& p) { return p != first; });
    for (auto third = other; third != corners.end(); ++third) {
        const Vec3 normal = exact_normal(first, *other, *third);
        if (normal == Vec3(0.0)) continue;
        const Vec3 size = magnitudes(normal);
        view.axis = largest(size.x, size.y, size.z);
        view.flipped = at(normal, view.axis) < 0.0;
        return true;
    }
    return false;
}

View view_across_line(const std::vector<Vec3>& corners) {
    Vec3 lower = corners[0];
    Vec3 upper = corners[0];
    for (const Vec3& p : corners) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    const Vec3 extent = upper - lower;
    return {largest(-extent.x, -extent.y, -extent.z), false};
}

} // namespace

void project_polygon(const std::vector<Vec3>& corners, std::vector<Vec2>& points) {
    View view{};
    if (!approximate_view(corners, view) && !exact_view(corners, view) && !view_of_first_triangle(corners, view)) {
        view = view_across_line(corners);
    }
    const int next = (view.axis + 1) % 3;
    const int last = (view.axis + 2) % 3;
    const int x = view.flipped ? last : next;
    const int y = view.flipped ? next : last;
    points.clear();
    for (const Vec3& p : corners) points.emplace_back(at(p, x), at(p, y));
}

} // namespace raywise
