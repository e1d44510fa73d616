// The one test of all leaves: a block of triangles against a ray, in float64 lanes.
//
// It takes the steps of triangle_test.h as long as float64 settles everything, by the same operations in the same order, so that its hits
// have the same bits; the few lanes that need more go to the test for one triangle. Nothing stands in front of it: with eight lanes of
// float64 it costs what a float32 filter would.
//
// For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
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

#include <cmath>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class Mask>
HWY_INLINE std::uint32_t triangle_bits(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(TriangleLanes(), mask, bytes);
    return bytes[0];
}

// What is known of the triangles in the lanes after a close look. Bits of lanes.
struct BlockHits {
    std::uint32_t misses;  // for certain
    std::uint32_t certain; // hits, by float64 alone
    alignas(64) double t[triangle_block_size];
    alignas(64) double u[triangle_block_size];
    alignas(64) double v[triangle_block_size];
};

// The steps of triangle_test_detail::test_closely, with bounds that are no smaller. What is certain here is so there. A corner's largest
// component relative to the origin is not had any more; it is between max |z| and that plus the largest sheared coordinate, because no
// shear is above 1.
HWY_INLINE void look_closely(const ExactRay& ray, const BlockCorner& a, const BlockCorner& b, const BlockCorner& c,
                             TriangleVector wa, TriangleVector wb, TriangleVector wc, BlockHits& hits) {
    const TriangleLanes d;
    const auto constant = [&](double value) HWY_ATTR { return hn::Set(d, value); };
    const TriangleVector z_low = hn::Min(hn::Min(a.z, b.z), c.z);
    const TriangleVector z_high = hn::Max(hn::Max(a.z, b.z), c.z);
    const TriangleVector farthest_z = hn::Max(z_high, hn::Neg(z_low));
    const TriangleVector ax = hn::Abs(a.x), ay = hn::Abs(a.y);
    const TriangleVector bx = hn::Abs(b.x), by = hn::Abs(b.y);
    const TriangleVector cx = hn::Abs(c.x), cy = hn::Abs(c.y);
    const TriangleVector reach = hn::Add(hn::Add(hn::Add(ax, ay), hn::Add(bx, by)), hn::Add(cx, cy));
    const TriangleVector farthest =
        hn::Add(hn::Max(hn::Max(hn::Max(ax, ay), hn::Max(bx, by)), hn::Max(cx, cy)), farthest_z);
    // 1.02 and 1.01 for the rounding of these sums.
    const TriangleVector shear_error = hn::Mul(constant(1.02 * 0x1p-50), farthest);
    const TriangleVector error = hn::Add(hn::Mul(shear_error, hn::Add(reach, hn::Add(shear_error, shear_error))),
                                         hn::Mul(hn::Mul(constant(1.01 * 0x1p-51), reach), reach));
    const TriangleVector highest = hn::Max(hn::Max(wa, wb), wc);
    const TriangleVector lowest = hn::Min(hn::Min(wa, wb), wc);
    const TriangleVector below = hn::Neg(error);
    const auto misses = hn::And(hn::Gt(highest, error), hn::Lt(lowest, below));
    const auto signs_certain = hn::Or(hn::Gt(lowest, error), hn::Lt(highest, below));

    const TriangleVector sum = hn::Add(hn::Add(wa, wb), wc);
    const TriangleVector area = hn::Abs(sum);
    const TriangleVector weight_error = hn::Mul(constant(3.0), error);
    const auto weights_certain = hn::And(
        hn::Le(hn::Mul(weight_error, constant(0x1p30)), area),
        hn::Le(hn::Mul(hn::Mul(weight_error, hn::Sub(z_high, z_low)), constant(0x1p40)), hn::Mul(area, farthest_z)));

    const TriangleVector u = hn::Div(wb, sum);
    const TriangleVector v = hn::Div(wc, sum);
    const TriangleVector mean = hn::Add(a.z, hn::Add(hn::Mul(u, hn::Sub(b.z, a.z)), hn::Mul(v, hn::Sub(c.z, a.z))));
    const TriangleVector z =
        hn::IfThenElse(hn::Lt(mean, z_low), z_low, hn::IfThenElse(hn::Lt(z_high, mean), z_high, mean));
    const TriangleVector t = hn::Mul(hn::Mul(z, constant(ray.inverse_major)), constant(ray.scale.inverse_length()));
    // Near the origin the sign of z is a matter for exact arithmetic.
    const auto away = hn::Gt(hn::Abs(z), hn::Mul(constant(0x1p-38), farthest));
    const auto in_range = hn::And(hn::Gt(farthest_z, constant(0x1p-400)), hn::Lt(farthest, constant(0x1p400)));

    hits.misses = triangle_bits(hn::And(misses, in_range));
    const auto certain = hn::And(hn::And(signs_certain, weights_certain), hn::And(away, in_range));
    hits.certain = ray.scale.is_normal() ? triangle_bits(certain) : 0;
    hn::Store(hn::Add(t, constant(0.0)), d, hits.t); // never a negative zero
    hn::Store(hn::Add(u, constant(0.0)), d, hits.u);
    hn::Store(hn::Add(v, constant(0.0)), d, hits.v);
}

// Which lanes certainly have no hit with t in [tmin, limit], without a division: most of what a ray's line meets lies behind its origin, as the
// surface that it starts on does, or behind what it has hit.
//
// For a triangle that is met, the exact edges W are of one sign, and the hit's z times |sum W| is the sum of W z with that sign. With D the
// distance, edges are off by less than C = certain_edge(D) each, z by 2^-53 D: the sum of w z is off by less than 4 C D, rounding
// included, and has the sign of the computed sum where that is beyond 4 C. The reported z is off by less than 2^-27 D more (ray/cell_ray.h).
HWY_INLINE std::uint32_t outside_interval(const ExactRay& ray, double distance, double certain, double limit,
                                          const BlockCorner& a, const BlockCorner& b, const BlockCorner& c,
                                          TriangleVector wa, TriangleVector wb, TriangleVector wc) {
    const TriangleLanes d;
    const TriangleVector sum = hn::Add(hn::Add(wa, wb), wc);
    const TriangleVector weighted = hn::Add(hn::Add(hn::Mul(wa, a.z), hn::Mul(wb, b.z)), hn::Mul(wc, c.z));
    const TriangleVector area = hn::Abs(sum);
    // Along the ray: by the sign of the sum, and of the direction along the major axis.
    const double along = std::fabs(at(ray.direction, ray.major_axis));
    const TriangleVector sign = hn::And(hn::Xor(sum, hn::Set(d, ray.inverse_major)), hn::SignBit(d));
    const TriangleVector z = hn::Xor(weighted, sign);
    const TriangleVector slack =
        hn::Add(hn::Mul(area, hn::Set(d, 0x1p-27 * distance)), hn::Set(d, 4.0 * certain * distance));
    const auto before = hn::Lt(hn::Add(z, slack), hn::Mul(area, hn::Set(d, ray.scaled_tmin * along)));
    const auto beyond = hn::Gt(hn::Sub(z, slack), hn::Mul(area, hn::Set(d, ray.scale.from_caller(limit) * along)));
    const auto outside = hn::And(hn::Or(before, beyond), hn::Gt(area, hn::Set(d, 4.0 * certain)));
    return ray.scale.is_normal() ? triangle_bits(outside) : 0;
}

// test_triangle_block for the triangles from `lane` on, as many as a register has lanes.
template <class T, class Collector>
HWY_INLINE bool test_lanes(const BlockRay& ray, const TriangleBlock<T>& block, std::uint32_t lane, double distance,
                           Collector& collector) {
    const TriangleLanes d;
    const auto [a, b, c] = block_triangles(ray, block, lane);
    const TriangleVector wa = block_edge(b, c);
    const TriangleVector wb = block_edge(c, a);
    const TriangleVector wc = block_edge(a, b);
    const TriangleVector highest = hn::Max(hn::Max(wa, wb), wc);
    const TriangleVector lowest = hn::Min(hn::Min(wa, wb), wc);
    const double certain = certain_edge(distance);
    const auto misses = hn::And(hn::Gt(highest, hn::Set(d, certain)), hn::Lt(lowest, hn::Set(d, -certain)));
    // Lanes behind the block hold anything.
    std::uint32_t bits = ~triangle_bits(misses) & ((1u << (block.n - lane)) - 1u) & ((1u << triangle_lanes) - 1u);
    if (HWY_LIKELY(bits == 0)) return false;
    bits &= ~outside_interval(ray.ray, distance, certain, collector.limit(), a, b, c, wa, wb, wc);
    if (bits == 0) return false;

    BlockHits hits;
    look_closely(ray.ray, a, b, c, wa, wb, wc, hits);
    for (bits &= ~hits.misses; bits != 0; bits &= bits - 1) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctz(bits));
        const std::uint32_t id = block.id(lane + i);
        if (HWY_LIKELY((hits.certain >> i & 1u) != 0)) {
            // Not the variable of below, which has an address and with it a place in memory.
            const PrimitiveHit hit{hits.t[i], hits.u[i], hits.v[i], id};
            if (ray.ray.contains(hit.t) && collector.collect(hit)) return true;
            continue;
        }
        PrimitiveHit hit;
        if (Primitives::test_corners(ray.ray, block.corners(lane + i), id, hit) && collector.collect(hit)) return true;
    }
    return false;
}

// Hands the hits of a ray with a block's triangles to the collector (accel/collectors.h), within the ray's interval.
// distance: no corner of the block is farther from the ray's origin along any axis. Returns whether the collector wants no more.
template <class T, class Collector>
HWY_INLINE bool test_triangle_block(const BlockRay& ray, const TriangleBlock<T>& block, double distance,
                                    Collector& collector) {
    if constexpr (triangle_lanes == triangle_block_size) {
        return test_lanes(ray, block, 0, distance, collector);
    } else {
        for (std::uint32_t lane = 0; lane < block.n; lane += triangle_lanes) {
            if (test_lanes(ray, block, lane, distance, collector)) return true;
        }
        return false;
    }
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
