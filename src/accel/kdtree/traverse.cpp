#include "accel/kdtree/traverse.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/kdtree/traverse.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/kdtree/traverse-inl.h"
#include "base/dispatch.h"

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

RW_RAY_KERNELS(KdTreelets)

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

RW_DISPATCH_RAY_KERNELS(KdTreelets)

} // namespace raywise
#endif
