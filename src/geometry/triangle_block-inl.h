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

#include "geometry/primitives.h"
#include "geometry/triangle_block.h"
#include "ray/exact_ray.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using TriangleLanes = hn::CappedTag<double, triangle_block_size>;
using TriangleVector = hn::VFromD<TriangleLanes>;
inline constexpr std::uint32_t triangle_lanes = hn::MaxLanes(TriangleLanes());

template <class Mask>
HWY_INLINE std::uint32_t triangle_bits(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(TriangleLanes(), mask, bytes);
    return bytes[0];
}

// A ray in all lanes, for as many blocks as it meets.
class BlockRay {
public:
    HWY_INLINE explicit BlockRay(const ExactRay& exact)
        : ray(exact),
          x(static_cast<std::size_t>(exact.x_axis)),
          y(static_cast<std::size_t>(exact.y_axis)),
          z(static_cast<std::size_t>(exact.major_axis)),
          origin_x(hn::Set(TriangleLanes(), exact.axis_origin.x)),
          origin_y(hn::Set(TriangleLanes(), exact.axis_origin.y)),
          origin_z(hn::Set(TriangleLanes(), exact.axis_origin.z)),
          shear_x(hn::Set(TriangleLanes(), exact.shear_x)),
          shear_y(hn::Set(TriangleLanes(), exact.shear_y)) {}

    const ExactRay& ray;
    std::size_t x, y, z; // axes
    TriangleVector origin_x, origin_y, origin_z;
    TriangleVector shear_x, shear_y;
};

// One corner of each triangle: relative to the origin, and sheared.
struct BlockCorner {
    TriangleVector dx, dy, z;
    TriangleVector x, y;

    HWY_INLINE TriangleVector largest_component() const {
        return hn::Max(hn::Max(hn::Abs(dx), hn::Abs(dy)), hn::Abs(z));
    }
};

HWY_INLINE TriangleVector load_coordinates(const double* line) { return hn::LoadU(TriangleLanes(), line); }
HWY_INLINE TriangleVector load_coordinates(const float* line) {
    return hn::PromoteTo(TriangleLanes(), hn::LoadU(hn::Rebind<float, TriangleLanes>(), line));
}

template <class T>
HWY_INLINE BlockCorner block_corner(const BlockRay& ray, const TriangleBlock<T>& block, std::size_t corner,
                                    std::uint32_t lane) {
    const TriangleVector dx = hn::Sub(load_coordinates(block.line(corner, ray.x) + lane), ray.origin_x);
    const TriangleVector dy = hn::Sub(load_coordinates(block.line(corner, ray.y) + lane), ray.origin_y);
    const TriangleVector z = hn::Sub(load_coordinates(block.line(corner, ray.z) + lane), ray.origin_z);
    return {dx, dy, z, hn::Sub(dx, hn::Mul(ray.shear_x, z)), hn::Sub(dy, hn::Mul(ray.shear_y, z))};
}

HWY_INLINE TriangleVector block_edge(const BlockCorner& p, const BlockCorner& q) {
    return hn::Sub(hn::Mul(p.x, q.y), hn::Mul(p.y, q.x));
}

// What is known of the triangles in the lanes after a close look (triangle_test_detail::test_closely). Bits of lanes.
struct BlockHits {
    std::uint32_t misses;  // for certain
    std::uint32_t certain; // hits, by float64 alone
    alignas(64) double t[triangle_block_size];
    alignas(64) double u[triangle_block_size];
    alignas(64) double v[triangle_block_size];
};

HWY_INLINE void look_closely(const ExactRay& ray, const BlockCorner& a, const BlockCorner& b, const BlockCorner& c,
                             TriangleVector wa, TriangleVector wb, TriangleVector wc, BlockHits& hits) {
    const TriangleLanes d;
    const auto constant = [&](double value) HWY_ATTR { return hn::Set(d, value); };
    const TriangleVector farthest =
        hn::Max(hn::Max(a.largest_component(), b.largest_component()), c.largest_component());
    TriangleVector reach = hn::Add(hn::Abs(a.x), hn::Abs(a.y));
    reach = hn::Add(hn::Add(reach, hn::Abs(b.x)), hn::Abs(b.y));
    reach = hn::Add(hn::Add(reach, hn::Abs(c.x)), hn::Abs(c.y));
    const TriangleVector shear_error = hn::Mul(constant(0x1p-50), farthest);
    const TriangleVector error =
        hn::Add(hn::Mul(hn::Mul(constant(1.01), shear_error), hn::Add(reach, hn::Mul(constant(2.0), shear_error))),
                hn::Mul(hn::Mul(constant(0x1p-51), reach), reach));
    const auto in_range = hn::And(hn::Gt(farthest, constant(0x1p-400)), hn::Lt(farthest, constant(0x1p400)));
    const TriangleVector highest = hn::Max(hn::Max(wa, wb), wc);
    const TriangleVector lowest = hn::Min(hn::Min(wa, wb), wc);
    const auto misses = hn::And(in_range, hn::And(hn::Gt(highest, error), hn::Lt(lowest, hn::Neg(error))));

    const TriangleVector z_low = hn::Min(hn::Min(a.z, b.z), c.z);
    const TriangleVector z_high = hn::Max(hn::Max(a.z, b.z), c.z);
    const TriangleVector smallest_edge = hn::Min(hn::Min(hn::Abs(wa), hn::Abs(wb)), hn::Abs(wc));
    const TriangleVector sum = hn::Add(hn::Add(wa, wb), wc);
    const TriangleVector area = hn::Abs(sum);
    const TriangleVector weight_error = hn::Mul(constant(3.0), error);
    const auto weights_certain = hn::And(
        hn::Le(hn::Mul(weight_error, constant(0x1p30)), area),
        hn::Le(hn::Mul(hn::Mul(weight_error, hn::Sub(z_high, z_low)), constant(0x1p40)), hn::Mul(area, farthest)));

    const TriangleVector u = hn::Div(wb, sum);
    const TriangleVector v = hn::Div(wc, sum);
    const TriangleVector mean = hn::Add(a.z, hn::Add(hn::Mul(u, hn::Sub(b.z, a.z)), hn::Mul(v, hn::Sub(c.z, a.z))));
    const TriangleVector z =
        hn::IfThenElse(hn::Lt(mean, z_low), z_low, hn::IfThenElse(hn::Lt(z_high, mean), z_high, mean));
    const TriangleVector z_error = hn::Mul(constant(0x1p-38), farthest);
    const auto around_origin = hn::And(hn::Le(z_low, constant(0.0)), hn::Ge(z_high, constant(0.0)));
    const auto near_origin =
        hn::And(hn::And(around_origin, hn::Le(hn::Abs(z), z_error)),
                hn::Le(constant(ray.scaled_tmin), hn::Mul(constant(2.0), z_error)));
    const TriangleVector t = hn::Mul(hn::Mul(z, constant(ray.inverse_major)), constant(ray.scale.inverse_length()));

    hits.misses = triangle_bits(misses);
    hits.certain = ray.scale.is_normal()
                       ? triangle_bits(hn::AndNot(
                             near_origin, hn::And(hn::And(in_range, hn::Gt(smallest_edge, error)), weights_certain)))
                       : 0;
    hn::Store(hn::Add(t, constant(0.0)), d, hits.t); // never a negative zero
    hn::Store(hn::Add(u, constant(0.0)), d, hits.u);
    hn::Store(hn::Add(v, constant(0.0)), d, hits.v);
}

// test_triangle_block for the triangles from `lane` on, as many as a register has lanes.
template <class T, class Collector>
HWY_INLINE bool test_lanes(const BlockRay& ray, const TriangleBlock<T>& block, std::uint32_t lane, double certain,
                           Collector& collector) {
    const TriangleLanes d;
    const BlockCorner a = block_corner(ray, block, 0, lane);
    const BlockCorner b = block_corner(ray, block, 1, lane);
    const BlockCorner c = block_corner(ray, block, 2, lane);
    const TriangleVector wa = block_edge(b, c);
    const TriangleVector wb = block_edge(c, a);
    const TriangleVector wc = block_edge(a, b);
    const TriangleVector highest = hn::Max(hn::Max(wa, wb), wc);
    const TriangleVector lowest = hn::Min(hn::Min(wa, wb), wc);
    const auto misses = hn::And(hn::Gt(highest, hn::Set(d, certain)), hn::Lt(lowest, hn::Set(d, -certain)));
    // Lanes behind the block hold anything.
    std::uint32_t bits = ~triangle_bits(misses) & ((1u << (block.n - lane)) - 1u) & ((1u << triangle_lanes) - 1u);
    if (HWY_LIKELY(bits == 0)) return false;

    BlockHits hits;
    look_closely(ray.ray, a, b, c, wa, wb, wc, hits);
    for (bits &= ~hits.misses; bits != 0; bits &= bits - 1) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctz(bits));
        const std::uint32_t id = block.id(lane + i);
        PrimitiveHit hit;
        if (HWY_LIKELY((hits.certain >> i & 1u) != 0)) {
            hit = {hits.t[i], hits.u[i], hits.v[i], id};
            if (!ray.ray.contains(hit.t)) continue;
        } else if (!Primitives::test_corners(ray.ray, block.corners(lane + i), id, hit)) {
            continue;
        }
        if (collector.collect(hit)) return true;
    }
    return false;
}

// Hands the hits of a ray with a block's triangles to the collector (accel/collectors.h), within the ray's interval.
// certain: certain_edge() of a distance that no corner of the block is beyond. Returns whether the collector wants no more.
template <class T, class Collector>
HWY_INLINE bool test_triangle_block(const BlockRay& ray, const TriangleBlock<T>& block, double certain,
                                    Collector& collector) {
    if constexpr (triangle_lanes == triangle_block_size) {
        return test_lanes(ray, block, 0, certain, collector);
    } else {
        for (std::uint32_t lane = 0; lane < block.n; lane += triangle_lanes) {
            if (test_lanes(ray, block, lane, certain, collector)) return true;
        }
        return false;
    }
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
