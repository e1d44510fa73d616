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

template <class AnyRay, class Collector>
HWY_INLINE void trace(const TracedGrid& grid, const AnyRay& ray, Collector& collector) {
    trace_grid(grid, widened(ray), collector);
}

RW_RAY_KERNELS(TracedGrid)

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

RW_DISPATCH_RAY_KERNELS(TracedGrid)

} // namespace raywise
#endif
