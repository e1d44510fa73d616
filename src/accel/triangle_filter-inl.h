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
// A corner's distance along the ray, z times the inverse of the direction there, is wrong by at most 4 u D, which is below e.
//
// For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_TRIANGLE_FILTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_TRIANGLE_FILTER_INL_H_
#undef RAYWISE_ACCEL_TRIANGLE_FILTER_INL_H_
#else
#define RAYWISE_ACCEL_TRIANGLE_FILTER_INL_H_
#endif

#include "accel/triangle_ray.h"

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A TriangleRay in all lanes.
template <class D>
struct FilterRay {
    using V = hn::VFromD<D>;

    HWY_INLINE FilterRay(D d, const TriangleRay& ray)
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

// The edges of triangles, as weights of their corners, and what each may be wrong by.
template <class V>
struct SignedEdges {
    V a, b, c;
    V highest, lowest;
    V error;
};

template <class D, class V = hn::VFromD<D>>
HWY_INLINE SignedEdges<V> edges_of(D d, const FilterRay<D>& ray, const ShearedCorners<V>& a, const ShearedCorners<V>& b,
                                   const ShearedCorners<V>& c) {
    const V wa = hn::MulSub(b.x, c.y, hn::Mul(b.y, c.x));
    const V wb = hn::MulSub(c.x, a.y, hn::Mul(c.y, a.x));
    const V wc = hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x));
    const V reach_a = hn::Max(hn::Abs(a.x), hn::Abs(a.y));
    const V reach_b = hn::Max(hn::Abs(b.x), hn::Abs(b.y));
    const V reach_c = hn::Max(hn::Abs(c.x), hn::Abs(c.y));
    const V reach = hn::Max(reach_a, hn::Max(reach_b, reach_c));
    // 2^-21 R^2 is twice 4 u R^2, for the rounding of this line.
    const V error = hn::MulAdd(reach, hn::MulAdd(hn::Set(d, 0x1p-21f), reach, ray.four_e), ray.two_e_e);
    return {wa, wb, wc, hn::Max(wa, hn::Max(wb, wc)), hn::Min(wa, hn::Min(wb, wc)), error};
}

// Which triangles the line of the ray may hit. A NaN or an infinity, of a ray of which nothing is known, keeps the triangle.
template <class V>
HWY_INLINE auto may_hit(const SignedEdges<V>& edges) {
    return hn::Not(hn::And(hn::Gt(edges.highest, edges.error), hn::Lt(edges.lowest, hn::Neg(edges.error))));
}

// The sum of the corners' distances from s, weighted by the edges: its sign, times that of the edges, says whether a hit lies beyond s
// or before it. What it may be wrong by: 3 (W e + M E), with W the largest edge and its error E, M the largest of the distances and e
// what they are wrong by; and the sum's rounding, below 12 u W M.
template <class V>
struct Beyond {
    V sum;
    V error;
};

template <class D, class V = hn::VFromD<D>>
HWY_INLINE Beyond<V> beyond(D d, const FilterRay<D>& ray, const SignedEdges<V>& edges, V largest_edge, V sa, V sb, V sc,
                            V s) {
    const V da = hn::Sub(sa, s);
    const V db = hn::Sub(sb, s);
    const V dc = hn::Sub(sc, s);
    const V sum = hn::MulAdd(edges.a, da, hn::MulAdd(edges.b, db, hn::Mul(edges.c, dc)));
    const V farthest = hn::Max(hn::Abs(da), hn::Max(hn::Abs(db), hn::Abs(dc)));
    const V per_edge = hn::MulAdd(farthest, hn::Set(d, 0x1p-20f), ray.four_e); // more than 3.1 e, and 12 u M
    return {sum, hn::MulAdd(hn::Mul(farthest, edges.error), hn::Set(d, 3.1f), hn::Mul(largest_edge, per_edge))};
}

// Which of the triangles that may be hit may be so at an s in [first, last].
template <class D, class V = hn::VFromD<D>>
HWY_INLINE auto may_hit_within(D d, const FilterRay<D>& ray, const SignedEdges<V>& edges, const ShearedCorners<V>& a,
                               const ShearedCorners<V>& b, const ShearedCorners<V>& c, V first, V last) {
    const V sa = hn::Mul(a.z, ray.inverse_z);
    const V sb = hn::Mul(b.z, ray.inverse_z);
    const V sc = hn::Mul(c.z, ray.inverse_z);
    const V largest_edge = hn::Add(hn::Max(edges.highest, hn::Neg(edges.lowest)), edges.error);
    const V area = hn::Add(edges.a, hn::Add(edges.b, edges.c));
    const V sign = hn::And(area, hn::SignBit(d));
    // Beyond the scene all distances are alike, and products of larger ones might overflow.
    const V bound = hn::Set(d, 16.0f);
    const Beyond<V> of_first =
        beyond(d, ray, edges, largest_edge, sa, sb, sc, hn::Max(hn::Min(first, bound), hn::Neg(bound)));
    const Beyond<V> of_last =
        beyond(d, ray, edges, largest_edge, sa, sb, sc, hn::Max(hn::Min(last, bound), hn::Neg(bound)));
    const auto before = hn::Lt(hn::Xor(of_first.sum, sign), hn::Neg(of_first.error));
    const auto after = hn::Gt(hn::Xor(of_last.sum, sign), of_last.error);
    const auto sign_certain = hn::Gt(hn::Abs(area), hn::Mul(edges.error, hn::Set(d, 4.0f)));
    return hn::Not(hn::And(sign_certain, hn::Or(before, after)));
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
