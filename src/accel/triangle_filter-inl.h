// Many triangles against one ray in float32: which of them the exact test has to look at. Errs towards yes.
//
// Corners p are in the coordinates of a SceneFrame, rounded to float32, and u is 2^-24. Sheared as in geometry/triangle_test.h, with
// D = 1 + L the largest difference between a corner and the ray's start (frame_ray.h): p and start are rounded by u (1 + L), their
// difference by u D, for z alike; the shear by u, its product with z by u D, the last difference by 2 u D. That is 8 u D in all, and
// `corner_error` e is twice that, with the start's own rounding added.
//
// With R the largest |x| or |y| of the three corners, an edge x1 y2 - y1 x2 is wrong by at most 4 R e + 2 e^2, and rounded by 4 u R^2,
// fused or not. Edges that are certainly of different signs are those of a miss, by exact arithmetic too.
//
// For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_TRIANGLE_FILTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_TRIANGLE_FILTER_INL_H_
#undef RAYWISE_ACCEL_TRIANGLE_FILTER_INL_H_
#else
#define RAYWISE_ACCEL_TRIANGLE_FILTER_INL_H_
#endif

#include "accel/frame_ray.h"

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The parts of a FrameRay that triangles need, in all lanes.
template <class D>
struct FilterRay {
    using V = hn::VFromD<D>;

    HWY_INLINE FilterRay(D d, const FrameRay& ray)
        : origin_x(hn::Set(d, ray.origin_x)),
          origin_y(hn::Set(d, ray.origin_y)),
          origin_z(hn::Set(d, ray.origin_z)),
          shear_x(hn::Set(d, ray.shear_x)),
          shear_y(hn::Set(d, ray.shear_y)),
          inverse_z(hn::Set(d, ray.inverse_z)),
          four_e(hn::Set(d, 4.001f * ray.corner_error)),
          two_e_e(hn::Set(d, 2.001f * ray.corner_error * ray.corner_error)) {}

    V origin_x, origin_y, origin_z;
    V shear_x, shear_y;
    V inverse_z;
    V four_e, two_e_e;
};

// One corner of each triangle, sheared.
template <class V>
struct ShearedCorners {
    V x, y, z;
};

template <class D, class V = hn::VFromD<D>>
HWY_INLINE ShearedCorners<V> shear(const FilterRay<D>& ray, V x, V y, V z) {
    const V dz = hn::Sub(z, ray.origin_z);
    return {hn::NegMulAdd(ray.shear_x, dz, hn::Sub(x, ray.origin_x)),
            hn::NegMulAdd(ray.shear_y, dz, hn::Sub(y, ray.origin_y)), dz};
}

// Which triangles a, b, c may be hit at an s in [first, last].
template <class D, class V = hn::VFromD<D>>
HWY_INLINE auto may_hit(D d, const FilterRay<D>& ray, const ShearedCorners<V>& a, const ShearedCorners<V>& b,
                        const ShearedCorners<V>& c, V first, V last) {
    const V wa = hn::MulSub(b.x, c.y, hn::Mul(b.y, c.x));
    const V wb = hn::MulSub(c.x, a.y, hn::Mul(c.y, a.x));
    const V wc = hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x));
    const V highest = hn::Max(wa, hn::Max(wb, wc));
    const V lowest = hn::Min(wa, hn::Min(wb, wc));

    const V reach_a = hn::Max(hn::Abs(a.x), hn::Abs(a.y));
    const V reach_b = hn::Max(hn::Abs(b.x), hn::Abs(b.y));
    const V reach_c = hn::Max(hn::Abs(c.x), hn::Abs(c.y));
    const V reach = hn::Max(reach_a, hn::Max(reach_b, reach_c));
    // 2^-21 R^2 is twice 4 u R^2, for the rounding of this line.
    const V error = hn::MulAdd(reach, hn::MulAdd(hn::Set(d, 0x1p-21f), reach, ray.four_e), ray.two_e_e);
    // A NaN or an infinity, of a ray of which nothing is known, keeps the triangle.
    const auto miss = hn::And(hn::Gt(highest, error), hn::Lt(lowest, hn::Neg(error)));

    // In front of the interval or behind it with all corners: distances are rounded by less than the margin.
    const V sa = hn::Mul(a.z, ray.inverse_z);
    const V sb = hn::Mul(b.z, ray.inverse_z);
    const V sc = hn::Mul(c.z, ray.inverse_z);
    const auto beyond = hn::Or(hn::Gt(hn::Min(sa, hn::Min(sb, sc)), last), hn::Lt(hn::Max(sa, hn::Max(sb, sc)), first));
    return hn::Not(hn::Or(miss, beyond));
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
