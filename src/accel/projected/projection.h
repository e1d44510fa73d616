// Projection of triangles and rays onto a plane of a view (Bezerianos, thesis, 3.1 and 5.1), with bounds for all
// rounding.
//
// A view's frame has three axes: two along the plane, u and v, and the depth along the direction the view looks. With a
// point P relative to the view's origin, seen through a point: (u, v) = (right . P, up . P) / (forward . P); seen along
// a direction: (u, v) = (right . P, up . P). Either takes a ray that starts at (runs along) the view to one point, and
// a triangle in front to a triangle. The axes are what is stored, rounded as they are: nothing below needs them to be
// orthogonal.
#pragma once

#include "accel/accel.h"
#include "accel/dense_region.h"
#include "ray/exact_ray.h"

#include <cmath>
#include <limits>
#include <vector>

namespace raywise {

// What a triangle, or several, cover on the plane: a rectangle and a range of depth. Empty: no ray the plane takes can
// hit them.
struct Footprint {
    Vec2 lower{std::numeric_limits<double>::infinity()};
    Vec2 upper{-std::numeric_limits<double>::infinity()};
    double near = std::numeric_limits<double>::infinity();
    double far = -std::numeric_limits<double>::infinity();

    bool empty() const { return !(near <= far); }
    void extend(const Footprint& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
        near = std::fmin(near, other.near);
        far = std::fmax(far, other.far);
    }
};

// A ray on the plane: a rectangle that holds the projection of its part beyond `cut`, almost a point, and its depth as
// a function of t. Whatever reaches nearer than `cut` may be hit outside of the rectangle.
struct ProjectedRay {
    Vec2 lower;
    Vec2 upper;
    double cut;
    double depth;       // at t = 0
    double depth_rate;  // per scaled t; never zero
    double depth_error; // of the depth of any point the ray can hit
};

class ProjectionPlane {
public:
    // The planes of a view: one, or six around a point (the thesis's light cube, 3.2.1; in the order +x, -x, +y, -y,
    // +z, -z); none where a view cannot be used, its point so far away that squares overflow, say.
    static std::vector<ProjectionPlane> of_view(const ViewFrame& view, const SceneExtent& scene);

    // Covers all points at which a ray that project() accepts can hit the triangle.
    Footprint footprint(const Corners& corners) const;

    // False when the plane cannot take the ray: it does not run through the view's point (in its direction), looks past
    // the plane, or passes the point.
    bool project(const ExactRay& ray, ProjectedRay& projected) const;

private:
    ProjectionPlane(ViewFrame::Kind kind, const Vec3& origin, const Vec3& forward, const SceneExtent& scene);

    struct Coordinates; // of a point in the frame, with bounds on their errors

    Coordinates coordinates(const Vec3& point) const;
    Footprint point_footprint(const Corners& corners, const Coordinates (&c)[3]) const;
    bool may_touch_core(const Corners& corners, const Coordinates (&c)[3]) const;
    bool project_from_point(const ExactRay& ray, ProjectedRay& projected) const;
    bool project_along_direction(const ExactRay& ray, ProjectedRay& projected) const;
    double depth_error(const Vec3& offset, double inverse_rate) const;

    ViewFrame::Kind kind_;
    Vec3 origin_;
    Vec3 right_;
    Vec3 up_;
    Vec3 forward_;
    double reach_;             // no point of the scene is farther from the origin on any axis
    double largest_extent_;    // of a primitive
    double core_ = 0.0;        // radius about the view's point; see project_from_point
    double slope_limit_ = 0.0; // |u| and |v| of the rays the plane takes
    double clip_limit_ = 0.0;  // |u| and |v| up to which it knows the scene

    friend class ViewPlanes;
};

// The planes of a view, and the choice among them.
class ViewPlanes {
public:
    ViewPlanes() = default;
    ViewPlanes(const ViewFrame& view, const SceneExtent& scene);

    const std::vector<ProjectionPlane>& planes() const { return planes_; }

    // The only plane that might take the ray; -1: none.
    int choose(const ExactRay& ray) const;

private:
    std::vector<ProjectionPlane> planes_;
};

// A float not above x, and one not below it, within a few units in the last place; for any x but NaN. Rounding moves a
// number by at most 2^-24 of it, or, where it is denormal, by 2^-150. Without a branch that depends on the last bits:
// each ray does it.
inline float float_above(double x) {
    constexpr double most = std::numeric_limits<float>::max();
    if (std::isinf(x)) return static_cast<float>(x);
    const double moved = x + (0x1p-23 * std::fabs(x) + 0x1p-149);
    if (moved > most) return std::numeric_limits<float>::infinity();
    return moved < -most ? -std::numeric_limits<float>::max() : static_cast<float>(moved);
}
inline float float_below(double x) { return -float_above(-x); }

} // namespace raywise
