#include "accel/grid/traverse.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/grid/traverse.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/grid/traverse-inl.h"
#include "base/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

template <class AnyRay>
HWY_INLINE PrimitiveHit closest(const TracedGrid& grid, const AnyRay& ray, const Query& query) {
    ClosestCollector collector(ray, query);
    trace_grid(grid, widened(ray), collector);
    return collector.best();
}

template <class AnyRay>
HWY_INLINE bool any(const TracedGrid& grid, const AnyRay& ray, const Query& query) {
    AnyCollector collector(ray, query);
    trace_grid(grid, widened(ray), collector);
    return collector.found();
}

PrimitiveHit closest_kernel(const TracedGrid& grid, const Ray& ray, const Query& query) {
    return closest(grid, ray, query);
}
PrimitiveHit closest_f32_kernel(const TracedGrid& grid, const RayF& ray, const Query& query) {
    return closest(grid, ray, query);
}
bool any_kernel(const TracedGrid& grid, const Ray& ray, const Query& query) { return any(grid, ray, query); }
bool any_f32_kernel(const TracedGrid& grid, const RayF& ray, const Query& query) { return any(grid, ray, query); }
void all_kernel(const TracedGrid& grid, const Ray& ray, AllCollector& collector) { trace_grid(grid, ray, collector); }

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(closest_kernel);
HWY_EXPORT(closest_f32_kernel);
HWY_EXPORT(any_kernel);
HWY_EXPORT(any_f32_kernel);
HWY_EXPORT(all_kernel);

PrimitiveHit grid_closest(const TracedGrid& grid, const Ray& ray, const Query& query) {
    return RW_DISPATCH(closest_kernel)(grid, ray, query);
}
PrimitiveHit grid_closest(const TracedGrid& grid, const RayF& ray, const Query& query) {
    return RW_DISPATCH(closest_f32_kernel)(grid, ray, query);
}
bool grid_any(const TracedGrid& grid, const Ray& ray, const Query& query) {
    return RW_DISPATCH(any_kernel)(grid, ray, query);
}
bool grid_any(const TracedGrid& grid, const RayF& ray, const Query& query) {
    return RW_DISPATCH(any_f32_kernel)(grid, ray, query);
}
void grid_all(const TracedGrid& grid, const Ray& ray, AllCollector& collector) {
    RW_DISPATCH(all_kernel)(grid, ray, collector);
}

} // namespace raywise
#endif
