#include "accel/projected/projection.h"

#include "ray/cell_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raywise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Added to bounds of errors: what products that underflow may lose, many times over.
constexpr double tiny = 0x1p-1000;

// Beyond, products of coordinates may overflow.
constexpr double largest_coordinate = 1e150;

double sum_of_magnitudes(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

Vec3 scaled_to_one(const Vec3& v) {
    const int exponent = std::ilogb(max_component(glm::abs(v)));
    return {std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), std::ldexp(v.z, -exponent)};
}

} // namespace

// A linear form of a point relative to the view's origin: a sum of three products of rounded differences. Each of the
// four roundings on the way of a term is 2^-53 of it, so 2^-50.9 of the sum of the terms' magnitudes is enough; four
// times as much is taken for the bound, so that what is computed from the coordinates (a quotient, another product, the
// bound itself) may round too.
struct ProjectionPlane::Coordinates {
    double value[3]; // right, up, forward
    double error[3];

    double low(int i) const { return value[i] - error[i]; }
    double high(int i) const { return value[i] + error[i]; }
};

ProjectionPlane::Coordinates ProjectionPlane::coordinates(const Vec3& point) const {
    const Vec3 p = point - origin_;
    const Vec3* const axes[3] = {&right_, &up_, &forward_};
    Coordinates c{};
    for (int i = 0; i < 3; ++i) {
        c.value[i] = glm::dot(*axes[i], p);
        c.error[i] = 0x1p-48 * glm::dot(glm::abs(*axes[i]), glm::abs(p)) + tiny;
    }
    return c;
}

ProjectionPlane::ProjectionPlane(ViewFrame::Kind kind, const Vec3& origin, const Vec3& forward,
                                 const SceneExtent& scene)
    : kind_(kind),
      origin_(origin),
      forward_(forward / std::sqrt(glm::dot(forward, forward))),
      reach_(max_component(glm::max(glm::abs(scene.bounds.lower - origin), glm::abs(scene.bounds.upper - origin)))),
      largest_extent_(scene.largest_extent) {
    // Across: the axis of coordinates that is farthest from `forward` keeps the frame well conditioned; for a cube's
    // planes the frame is made of the axes themselves and does not round.
    const Vec3 size = glm::abs(forward_);
    Vec3 other(0.0);
    other[size.x <= size.y ? (size.x <= size.z ? 0 : 2) : (size.y <= size.z ? 1 : 2)] = 1.0;
    const Vec3 across = glm::cross(other, forward_);
    right_ = across / std::sqrt(glm::dot(across, across));
    up_ = glm::cross(forward_, right_);
}

std::vector<ProjectionPlane> ProjectionPlane::of_view(const ViewFrame& view, const SceneExtent& scene) {
    std::vector<ProjectionPlane> planes;
    const Box& bounds = scene.bounds;
    if (bounds.empty() || !is_finite(view.origin) || !is_finite(view.direction)) return planes;
    const bool has_direction = view.direction != Vec3(0.0);

    if (view.kind == ViewFrame::Kind::direction) {
        if (!has_direction) return planes;
        planes.push_back(ProjectionPlane(view.kind, bounds.center(), scaled_to_one(view.direction), scene));
        return planes;
    }

    if (max_component(glm::abs(view.origin)) > largest_coordinate) return planes;
    // Rays that aim at the point in float32 pass it by 2^-24 of their length. Where the scene reaches so far that most of it would be in
    // the core, the rays from its far end are left to the other trees.
    const double reach =
        max_component(larger(magnitudes(bounds.lower - view.origin), magnitudes(bounds.upper - view.origin)));
    const double core = smaller(0x1p-18 * reach, 0.25 * scene.near_distance(view.origin));
    // Rays at the very edge belong to the plane, whichever way their slope is rounded.
    constexpr double rounding = 1.0 + 0x1p-20;
    const auto add = [&](const Vec3& forward, double slope) {
        ProjectionPlane plane(view.kind, view.origin, forward, scene);
        plane.core_ = core;
        plane.slope_limit_ = slope * rounding;
        plane.clip_limit_ = plane.slope_limit_ + 0.125 * std::max(1.0, plane.slope_limit_);
        planes.push_back(plane);
    };
    if (has_direction) {
        constexpr double right_angle = 1.5707963267948966;
        const bool usable = view.half_angle > 0.0 && view.half_angle < right_angle;
        add(scaled_to_one(view.direction), usable ? std::tan(view.half_angle) : 1.0);
    } else {
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 forward(0.0);
            forward[axis] = 1.0;
            add(forward, 1.0);
            add(-forward, 1.0);
        }
    }
    return planes;
}

// ---- Triangles.

Footprint ProjectionPlane::footprint(const Corners& corners) const {
    const Coordinates c[3] = {coordinates(corners[0]), coordinates(corners[1]), coordinates(corners[2])};
    if (kind_ == ViewFrame::Kind::point) return point_footprint(corners, c);

    // A linear map: the corners' extremes, with their errors.
    Footprint footprint;
    for (const Coordinates& corner : c) {
        footprint.extend(
            {{corner.low(0), corner.low(1)}, {corner.high(0), corner.high(1)}, corner.low(2), corner.high(2)});
    }
    return footprint;
}

// A ray that project() accepts can hit the triangle either within the core (see there), or at depth > 0 with |u| and
// |v| up to clip_limit_. Whatever may touch the core covers all of the plane, at any depth its corners have. For all
// others, with the second kind of points only:
//
// - u <= s there if right . P <= s * (forward . P) at all three corners, behind the view's plane or in front: the
//   difference is linear, so it has one sign all over the triangle, and dividing by the depth, positive at the points
//   that count, keeps it. For a triangle that straddles the view's plane this finds the one finite side it may have.
//   Bounds from below by mirroring.
// - If u > clip_limit_ at all of the triangle (the same linear test), no such point exists: the plane need not know it.
// - Where all corners have right . P >= a > 0 the depth is at least a / clip_limit_: a floor that runs under the point
//   is far away within the pyramid that looks at the horizon.
Footprint ProjectionPlane::point_footprint(const Corners& corners, const Coordinates (&c)[3]) const {
    Footprint footprint;
    footprint.near = std::min({c[0].low(2), c[1].low(2), c[2].low(2)});
    footprint.far = std::max({c[0].high(2), c[1].high(2), c[2].high(2)});
    if (may_touch_core(corners, c)) {
        footprint.lower = Vec2(-infinity);
        footprint.upper = Vec2(infinity);
        return footprint;
    }
    if (footprint.far <= 0.0) return {};

    for (int side = 0; side < 2; ++side) {
        for (int i = 0; i < 2; ++i) {
            // Seen from this side "high" is out, away from the middle; a mirror swaps low and high and their signs.
            const auto high = [&](const Coordinates& p) { return side == 0 ? p.high(i) : -p.low(i); };
            const auto low = [&](const Coordinates& p) { return side == 0 ? p.low(i) : -p.high(i); };

            bool outside = true;     // beyond the clip limit on this side
            double least = infinity; // of the coordinate
            double slope = -infinity;
            for (const Coordinates& p : c) {
                // With half of the error to spare for the rounding of the product and the sum.
                const double limit = clip_limit_ * p.value[2];
                outside = outside && low(p) - limit > clip_limit_ * p.error[2] + 0x1p-50 * std::fabs(limit);
                least = std::min(least, low(p));
                if (p.low(2) > 0.0) slope = std::max(slope, high(p) / (high(p) >= 0.0 ? p.low(2) : p.high(2)));
            }
            if (outside) return {};
            if (slope == -infinity) slope = infinity; // no corner is certainly in front
            for (const Coordinates& p : c) {
                if (p.low(2) > 0.0 || slope == infinity) continue;
                for (const double depth : {p.low(2), p.high(2)}) {
                    const double bound = slope * depth;
                    if (!(high(p) + 0x1p-50 * std::fabs(bound) <= bound)) slope = infinity;
                }
            }
            (side == 0 ? footprint.upper : footprint.lower)[i] = side == 0 ? slope : -slope;
            if (least > 0.0) footprint.near = std::max(footprint.near, least / clip_limit_ * (1.0 - 0x1p-50));
        }
    }
    footprint.near = std::min(footprint.near, footprint.far); // by rounding only: not empty
    return footprint;
}

// False only when the triangle is certainly farther than core_ from the view's point.
bool ProjectionPlane::may_touch_core(const Corners& corners, const Coordinates (&c)[3]) const {
    // Beyond a plane across one of the frame's axes, of unit length but for rounding.
    const double distance = core_ * (1.0 + 0x1p-40);
    for (int i = 0; i < 3; ++i) {
        if (c[0].low(i) > distance && c[1].low(i) > distance && c[2].low(i) > distance) return false;
        if (c[0].high(i) < -distance && c[1].high(i) < -distance && c[2].high(i) < -distance) return false;
    }
    // Or in a plane that passes the point farther away. With edges up to e the normal's components are wrong by less
    // than 2^-50 e^2, and its product with a corner, m from the point, by less than 2^-47 e^2 m. (Tiny edges: no
    // underflow.)
    const Vec3 p = corners[0] - origin_;
    const Vec3 a = corners[1] - corners[0];
    const Vec3 b = corners[2] - corners[0];
    const double m = max_component(glm::abs(p));
    const double e = std::max(max_component(glm::abs(a)), max_component(glm::abs(b)));
    const Vec3 n = glm::cross(a, b);
    return !(e > 1e-120 &&
             std::fabs(glm::dot(n, p)) > distance * sum_of_magnitudes(n) + 0x1p-44 * e * e * (m + distance));
}

// ---- Rays.

bool ProjectionPlane::project(const ExactRay& ray, ProjectedRay& projected) const {
    return kind_ == ViewFrame::Kind::point ? project_from_point(ray, projected)
                                           : project_along_direction(ray, projected);
}

// Of z0 + t * rate, at all points of the scene. `offset`: of the ray's origin. z0 is wrong by less than 2^-50 of the
// offset, the rate by less than 2^-47 (its terms are below 2, 6 in sum). A hit's |t * rate| is at most the depth of the
// scene and z0 together, below 4 (reach + |offset|), so |t| is below that over the rate; and the product rounds. A
// limit on t that is farther off leads to a depth farther than all of the scene, on the right side, whatever it rounds
// to.
double ProjectionPlane::depth_error(const Vec3& offset, double inverse_rate) const {
    return 0x1p-43 * (sum_of_magnitudes(offset) + reach_) * (1.0 + std::fabs(inverse_rate)) + tiny;
}

// The ray's line, by depth z: right . P = a + b z with b = dx / dz and a = x0 - z0 b, where (x0, y0, z0) is the ray's
// origin and (dx, dy, dz) its direction in the frame. So u = b + a / z. A ray from the view's point has a = 0, and is
// one point of the plane. A ray that aims at the point, its direction rounded, passes it by a tiny a: u stays within
// |a| / cut of b down to the depth `cut`. Nearer by than that a node is not judged by its rectangle.
//
// A ray is only accepted when what happens around the point is in the core, a ball of radius core_ whose triangles
// cover all of the plane:
// - Hits have t* a little outside of what the ray asks for (hit_error): from there follows the least depth `least` of any hit.
// - At depths above `inner`, |u| = |b + a / z| is below clip_limit_, where the plane knows all of the scene.
// - At depths between `least` and `inner` the line stays within core_ / 2 of the point on each axis of the frame.
bool ProjectionPlane::project_from_point(const ExactRay& ray, ProjectedRay& projected) const {
    const double dz = glm::dot(forward_, ray.direction);
    if (!(std::fabs(dz) > 0x1p-40)) return false;
    const double inverse = 1.0 / dz;
    const Vec2 b = Vec2(glm::dot(right_, ray.direction), glm::dot(up_, ray.direction)) * inverse;
    const double slope = std::max(std::fabs(b.x), std::fabs(b.y));
    // dx and dz are wrong by less than 2^-49 * 6 each.
    const double slope_error = 0x1p-46 * (1.0 + slope) * std::fabs(inverse);
    if (!(slope + slope_error <= slope_limit_)) return false;

    const Vec3 offset = ray.origin - origin_;
    double depth = 0.0;
    double a = 0.0; // bound on |a| for u and v
    if (offset != Vec3(0.0)) {
        depth = glm::dot(forward_, offset);
        const double x = glm::dot(right_, offset) - depth * b.x;
        const double y = glm::dot(up_, offset) - depth * b.y;
        const double error =
            0x1p-47 * sum_of_magnitudes(offset) * (1.0 + slope) + 2.0 * std::fabs(depth) * slope_error + tiny;
        a = std::max(std::fabs(x), std::fabs(y)) + error;
        if (!(a <= core_)) return false; // passes the point
    }

    const double tmax = ray.scale.from_caller(ray.tmax);
    double least = depth + (dz > 0.0 ? (ray.scaled_tmin - hit_error(ray.scaled_tmin, largest_extent_)) * dz
                                     : (tmax + hit_error(tmax, largest_extent_)) * dz);
    const double depth_slack = depth_error(offset, inverse);
    least -= depth_slack + 0x1p-44 * std::fabs(least) * (1.0 + std::fabs(inverse));
    const double inner = a / (clip_limit_ - slope_limit_);
    if (!(least > inner)) {
        const double farthest = std::max(-least, inner);
        if (!(a + std::max(1.0, slope_limit_) * farthest <= 0.5 * core_)) return false;
    }

    // A cut that leaves as little undecided before it as beyond it, relative to the scene; or none, where there is no
    // hit before it.
    double cut = -infinity;
    double spread = slope_error;
    if (a > 0.0) {
        const double nearest = std::max(inner, std::sqrt(a * reach_));
        if (!(least >= nearest)) cut = nearest;
        spread += a / std::max(nearest, least) * (1.0 + 0x1p-50);
    }
    if (!(spread <= 0.125)) return false;
    projected = {b - spread, b + spread, cut, depth, dz, depth_slack};
    return true;
}

// Here u = a + b z itself is the line, and b nearly zero. All of the scene has |z| below `extent`.
bool ProjectionPlane::project_along_direction(const ExactRay& ray, ProjectedRay& projected) const {
    const double dz = glm::dot(forward_, ray.direction);
    if (!(std::fabs(dz) > 0x1p-1)) return false;
    const double inverse = 1.0 / dz;
    const Vec2 b = Vec2(glm::dot(right_, ray.direction), glm::dot(up_, ray.direction)) * inverse;
    const double slope = std::max(std::fabs(b.x), std::fabs(b.y));
    if (!(slope <= 0x1p-12)) return false; // not parallel

    const Vec3 offset = ray.origin - origin_;
    if (!(max_component(glm::abs(offset)) <= largest_coordinate)) return false;
    const double depth = glm::dot(forward_, offset);
    const Vec2 a = Vec2(glm::dot(right_, offset), glm::dot(up_, offset)) - depth * b;
    const double slope_error = 0x1p-46 * std::fabs(inverse);
    const double error = 0x1p-47 * sum_of_magnitudes(offset) + 2.0 * std::fabs(depth) * slope_error + tiny;
    const double extent = 2.0 * reach_; // the axes are of unit length, and sqrt(3) < 2
    const double spread = (slope + slope_error) * extent * (1.0 + 0x1p-50) + error;
    if (!(spread <= 0x1p-8 * reach_)) return false; // would meet too many rectangles, if it is not a lost cause
    projected = {a - spread, a + spread, -infinity, depth, dz, depth_error(offset, inverse)};
    return true;
}

// ---- The choice of a plane.

ViewPlanes::ViewPlanes(const ViewFrame& view, const SceneExtent& scene)
    : planes_(ProjectionPlane::of_view(view, scene)) {}

int ViewPlanes::choose(const ExactRay& ray) const {
    if (planes_.size() < 6) return static_cast<int>(planes_.size()) - 1;
    // Away from the point, or towards it.
    const Vec3 offset = ray.origin - planes_.front().origin_;
    const bool away =
        !(max_component(glm::abs(offset)) > 0.5 * planes_.front().core_) || glm::dot(offset, ray.direction) >= 0.0;
    const bool positive = (ray.direction[ray.major_axis] > 0.0) == away;
    return 2 * ray.major_axis + (positive ? 0 : 1);
}

} // namespace raywise
