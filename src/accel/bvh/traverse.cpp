#include "accel/bvh/traverse.h"

#include <algorithm>

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/bvh/traverse.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/bvh/stream-inl.h"
#include "accel/bvh/traverse-inl.h"
#include "base/dispatch.h"
#include "ray/traversal_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

template <class T, class AnyRay, class Collector>
HWY_INLINE void trace_as(const WideBvh& bvh, const AnyRay& ray, Collector& collector) {
    TraversalRay traversal;
    RayTime time;
    if (HWY_UNLIKELY(set_up_ray(ray, bvh.frame, traversal, time) != RaySetup::ready)) return;
    std::optional<ExactRay> exact;
    TracedRay<T, AnyRay, Collector> traced{bvh, ray, traversal, time, collector, exact};
    traverse(traced, NodeRef::node(0));
}

template <class AnyRay, class Collector>
HWY_INLINE void trace(const WideBvh& bvh, const AnyRay& ray, Collector& collector) {
    if (bvh.nodes.empty()) return;
    if (bvh.is_float64) {
        trace_as<double>(bvh, ray, collector);
    } else {
        trace_as<float>(bvh, ray, collector);
    }
}

RW_RAY_KERNELS(WideBvh)

// A stream of fewer is not worth what it takes to make it ready.
constexpr std::size_t smallest_stream = 32;

template <class AnyRay, class Collector>
HWY_INLINE void trace_many(const WideBvh& bvh, const PacketOf<AnyRay>& rays, Collector* collectors, Scratch& scratch) {
    if (bvh.nodes.empty()) return;
    if (rays.count < smallest_stream) {
        for (std::size_t i = 0; i < rays.count; ++i) trace(bvh, rays.rays[i], collectors[i]);
    } else if (bvh.is_float64) {
        trace_streams<double>(bvh, rays, collectors, scratch);
    } else {
        trace_streams<float>(bvh, rays, collectors, scratch);
    }
}

template <class AnyRay>
HWY_INLINE void closest_many(const WideBvh& bvh, const PacketOf<AnyRay>& rays, PrimitiveHit* hits, Scratch& scratch) {
    const Collectors<ClosestCollector> collectors(rays, scratch);
    trace_many(bvh, rays, collectors.data(), scratch);
    for (std::size_t i = 0; i < rays.count; ++i) hits[i] = collectors[i].best();
}

template <class AnyRay>
HWY_INLINE void any_many(const WideBvh& bvh, const PacketOf<AnyRay>& rays, bool* found, Scratch& scratch) {
    const Collectors<AnyCollector> collectors(rays, scratch);
    trace_many(bvh, rays, collectors.data(), scratch);
    for (std::size_t i = 0; i < rays.count; ++i) found[i] = collectors[i].found();
}

void closest_many_kernel(const WideBvh& bvh, const RayPacket& rays, PrimitiveHit* hits, Scratch& scratch) {
    closest_many(bvh, rays, hits, scratch);
}
void closest_many_f32_kernel(const WideBvh& bvh, const RayPacketF& rays, PrimitiveHit* hits, Scratch& scratch) {
    closest_many(bvh, rays, hits, scratch);
}
void any_many_kernel(const WideBvh& bvh, const RayPacket& rays, bool* found, Scratch& scratch) {
    any_many(bvh, rays, found, scratch);
}
void any_many_f32_kernel(const WideBvh& bvh, const RayPacketF& rays, bool* found, Scratch& scratch) {
    any_many(bvh, rays, found, scratch);
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

RW_DISPATCH_RAY_KERNELS(WideBvh)

HWY_EXPORT(closest_many_kernel);
HWY_EXPORT(closest_many_f32_kernel);
HWY_EXPORT(any_many_kernel);
HWY_EXPORT(any_many_f32_kernel);

void trace_closest_many(const WideBvh& bvh, const RayPacket& rays, PrimitiveHit* hits, Scratch& scratch) {
    HWY_DYNAMIC_DISPATCH(closest_many_kernel)(bvh, rays, hits, scratch);
}
void trace_closest_many(const WideBvh& bvh, const RayPacketF& rays, PrimitiveHit* hits, Scratch& scratch) {
    HWY_DYNAMIC_DISPATCH(closest_many_f32_kernel)(bvh, rays, hits, scratch);
}
void trace_any_many(const WideBvh& bvh, const RayPacket& rays, bool* found, Scratch& scratch) {
    HWY_DYNAMIC_DISPATCH(any_many_kernel)(bvh, rays, found, scratch);
}
void trace_any_many(const WideBvh& bvh, const RayPacketF& rays, bool* found, Scratch& scratch) {
    HWY_DYNAMIC_DISPATCH(any_many_f32_kernel)(bvh, rays, found, scratch);
}

} // namespace raywise
#endif
