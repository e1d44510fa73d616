#include "ray/set_ups.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ray/set_ups.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/dispatch.h"
#include "ray/traversal_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

RaySetup set_up_kernel(const Ray& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time) {
    return set_up_ray(ray, frame, result, time);
}
RaySetup set_up_f32_kernel(const RayF& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time) {
    return set_up_ray(ray, frame, result, time);
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(set_up_kernel);
HWY_EXPORT(set_up_f32_kernel);

RaySetup set_up_in_vectors(const Ray& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time) {
    return RW_DISPATCH(set_up_kernel)(ray, frame, result, time);
}
RaySetup set_up_in_vectors(const RayF& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time) {
    return RW_DISPATCH(set_up_f32_kernel)(ray, frame, result, time);
}

} // namespace raywise
#endif
