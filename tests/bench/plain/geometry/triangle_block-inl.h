// Stands in for src/geometry/triangle_block-inl.h in libraywise-plain, to tell what exactness costs: the same edge functions in the same
// lanes, whose signs are believed as float64 computes them. No error bounds, no second look, no test that decides.
#if defined(RAYWISE_GEOMETRY_TRIANGLE_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_GEOMETRY_TRIANGLE_BLOCK_INL_H_
#undef RAYWISE_GEOMETRY_TRIANGLE_BLOCK_INL_H_
#else
#define RAYWISE_GEOMETRY_TRIANGLE_BLOCK_INL_H_
#endif

#include "geometry/block_edges-inl.h"
#include "geometry/primitives.h"
#include "geometry/triangle_block.h"
#include "ray/exact_ray.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class T, class Collector>
HWY_INLINE bool test_lanes(const BlockRay& ray, const TriangleBlock<T>& block, std::uint32_t lane,
                           Collector& collector) {
    const TriangleLanes d;
    const auto [a, b, c] = block_triangles(ray, block, lane);
    const TriangleVector wa = block_edge(b, c);
    const TriangleVector wb = block_edge(c, a);
    const TriangleVector wc = block_edge(a, b);
    const TriangleVector zero = hn::Zero(d);
    const auto inside = hn::Or(hn::Ge(hn::Min(hn::Min(wa, wb), wc), zero), hn::Le(hn::Max(hn::Max(wa, wb), wc), zero));
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, inside, bytes);
    // Lanes behind the block hold anything.
    std::uint32_t bits = bytes[0] & ((1u << (block.n - lane)) - 1u) & ((1u << triangle_lanes) - 1u);
    if (HWY_LIKELY(bits == 0)) return false;

    const TriangleVector sum = hn::Add(hn::Add(wa, wb), wc);
    const TriangleVector u = hn::Div(wb, sum);
    const TriangleVector v = hn::Div(wc, sum);
    const TriangleVector z = hn::Add(a.z, hn::Add(hn::Mul(u, hn::Sub(b.z, a.z)), hn::Mul(v, hn::Sub(c.z, a.z))));
    const TriangleVector per_z = hn::Set(d, ray.ray.inverse_major * ray.ray.scale.inverse_length());
    alignas(64) double t_of[triangle_block_size];
    alignas(64) double u_of[triangle_block_size];
    alignas(64) double v_of[triangle_block_size];
    hn::Store(hn::Mul(z, per_z), d, t_of);
    hn::Store(u, d, u_of);
    hn::Store(v, d, v_of);
    for (; bits != 0; bits &= bits - 1) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctz(bits));
        // A triangle seen edge-on has no t, and is in no interval.
        if (!ray.ray.contains(t_of[i])) continue;
        if (collector.collect(PrimitiveHit{t_of[i], u_of[i], v_of[i], block.id(lane + i)})) return true;
    }
    return false;
}

template <class T, class Collector>
HWY_INLINE bool test_triangle_block(const BlockRay& ray, const TriangleBlock<T>& block, double, Collector& collector) {
    if constexpr (triangle_lanes == triangle_block_size) {
        return test_lanes(ray, block, 0, collector);
    } else {
        for (std::uint32_t lane = 0; lane < block.n; lane += triangle_lanes) {
            if (test_lanes(ray, block, lane, collector)) return true;
        }
        return false;
    }
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
