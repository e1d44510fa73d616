#include "accel/kdtree/traverse.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/kdtree/traverse.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/kdtree/traverse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

template <class AnyRay, class Collector>
HWY_INLINE void trace(const KdTreelets& tree, const AnyRay& ray, Collector& collector) {
    if (tree.treelets.empty()) return;
    if (tree.is_float64) {
        trace_kd_tree<double>(tree, ray, collector);
    } else {
        trace_kd_tree<float>(tree, ray, collector);
    }
}

template <class AnyRay>
HWY_INLINE PrimitiveHit closest(const KdTreelets& tree, const AnyRay& ray, const Query& query) {
    ClosestCollector collector(ray, query);
    trace(tree, ray, collector);
    return collector.best();
}

template <class AnyRay>
HWY_INLINE bool any(const KdTreelets& tree, const AnyRay& ray, const Query& query) {
    AnyCollector collector(ray, query);
    trace(tree, ray, collector);
    return collector.found();
}

PrimitiveHit closest_kernel(const KdTreelets& tree, const Ray& ray, const Query& query) {
    return closest(tree, ray, query);
}
PrimitiveHit closest_f32_kernel(const KdTreelets& tree, const RayF& ray, const Query& query) {
    return closest(tree, ray, query);
}
bool any_kernel(const KdTreelets& tree, const Ray& ray, const Query& query) { return any(tree, ray, query); }
bool any_f32_kernel(const KdTreelets& tree, const RayF& ray, const Query& query) { return any(tree, ray, query); }
void all_kernel(const KdTreelets& tree, const Ray& ray, AllCollector& collector) { trace(tree, ray, collector); }

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/dispatch.h"

namespace raywise {

HWY_EXPORT(closest_kernel);
HWY_EXPORT(closest_f32_kernel);
HWY_EXPORT(any_kernel);
HWY_EXPORT(any_f32_kernel);
HWY_EXPORT(all_kernel);

PrimitiveHit trace_closest(const KdTreelets& tree, const Ray& ray, const Query& query) {
    return RW_DISPATCH(closest_kernel)(tree, ray, query);
}
PrimitiveHit trace_closest(const KdTreelets& tree, const RayF& ray, const Query& query) {
    return RW_DISPATCH(closest_f32_kernel)(tree, ray, query);
}
bool trace_any(const KdTreelets& tree, const Ray& ray, const Query& query) {
    return RW_DISPATCH(any_kernel)(tree, ray, query);
}
bool trace_any(const KdTreelets& tree, const RayF& ray, const Query& query) {
    return RW_DISPATCH(any_f32_kernel)(tree, ray, query);
}
void trace_all(const KdTreelets& tree, const Ray& ray, AllCollector& collector) {
    HWY_DYNAMIC_DISPATCH(all_kernel)(tree, ray, collector);
}

} // namespace raywise
#endif
