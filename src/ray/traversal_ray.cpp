#include "ray/traversal_ray.h"

#include "base/expansion.h"
#include "ray/direction_scale.h"
#include "ray/exact_ray.h"
#include "ray/nearest_point.h"

namespace raywise {

MovedStart::MovedStart(const Vec3& origin, const Vec3& direction, const SceneFrame& frame) {
    const Vec3 center = frame.center();
    start = frame.to_frame(origin);
    error = 0x1p-103 * max_component(magnitudes(start));
    moved = move_to_nearest(start, direction, Vec3(0.0));
    // What the difference from the center was rounded by.
    for (int axis = 0; axis < 3; ++axis) start[axis] += two_sum(origin[axis], -center[axis]).low * frame.scale();
    moved += move_to_nearest(start, direction, Vec3(0.0));
}

namespace {

// start_error: of the start along any axis, besides what is relative to it.
void set_axes(const Vec3& start, double start_error, const Vec3& direction, TraversalRay& result) {
    result.octant = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto along = static_cast<float>(direction[axis]);
        const float inverse =
            std::copysign(1.0f / std::fmax(std::fabs(along), TraversalRay::smallest_direction), along);
        const float offset = static_cast<float>(start[axis]) * inverse;
        const float slack =
            TraversalRay::offset_slack * std::fabs(offset) + static_cast<float>(start_error) * std::fabs(inverse);
        result.inverse[axis] = inverse;
        result.entry_offset[axis] = offset + slack;
        result.exit_offset[axis] = offset - slack;
        result.direction[axis] = along;
        if (inverse < 0.0f) result.octant |= 1u << axis;
    }
}

// Every box is visited: any plane in the frame is passed at -2^50 or 2^50, while those of empty children stay in the wrong order.
void know_nothing(TraversalRay& result, RayTime& time) {
    result.octant = 0;
    for (int axis = 0; axis < 3; ++axis) {
        result.inverse[axis] = 0x1p-40f;
        result.entry_offset[axis] = 0x1p50f;
        result.exit_offset[axis] = -0x1p50f;
        result.direction[axis] = 1.0f;
    }
    time.scale = 0.0;
    time.moved = 0.0;
    time.error = time.origin_distance = std::numeric_limits<double>::infinity();
}

} // namespace

RaySetup set_up_rare_ray(const Ray& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time) {
    if (!ray.is_traceable()) return RaySetup::untraceable;
    const DirectionScale scale(MajorAxis(ray.direction).magnitude);
    Vec3 direction;
    for (int axis = 0; axis < 3; ++axis) direction[axis] = scale.to_caller(ray.direction[axis]);
    const Vec3 center = frame.center();
    time.scale = scale.from_caller(frame.scale());
    time.length = scale.length();
    time.moved = 0.0;
    time.error = 0.0;
    time.origin_distance = max_component(magnitudes(ray.origin - center));

    const Vec3 start = frame.to_frame(ray.origin);
    const double distance = max_component(magnitudes(start));
    if (!(time.scale >= 0x1p-500 && time.scale <= 0x1p500) || !(distance < MovedStart::farthest)) {
        know_nothing(result, time);
    } else if (distance > frame.near()) {
        const MovedStart moved(ray.origin, direction, frame);
        // No point of the scene is farther than sqrt(3) from the center.
        if (max_component(magnitudes(moved.start)) > 2.0) return RaySetup::misses;
        time.moved = moved.moved;
        time.error = 0x1p-48 * std::fabs(moved.moved);
        set_axes(moved.start, moved.error, direction, result);
    } else {
        set_axes(start, 0.0, direction, result);
    }
    result.first = time.first(ray.tmin);
    result.last = time.last(ray.tmax);
    if (!(time.error < std::numeric_limits<double>::infinity())) {
        result.first = -std::numeric_limits<float>::max();
        result.last = std::numeric_limits<float>::max();
    }
    return RaySetup::ready;
}

} // namespace raywise
