// Many triangles against one ray in float32: which of them the exact test has to look at. Errs towards yes.
//
// Corners are in the coordinates of a SceneFrame, rounded to float32, and u is 2^-24. They are sheared as in geometry/triangle_test.h;
// what a sheared coordinate is wrong by, e, comes with the ray (TriangleRay): of a FrameRay, with D = 1 + L the largest difference
// between a corner and the ray's start: p and start are rounded by u (1 + L), their difference by u D, for z alike; the shear by u, its
// product with z by u D, the last difference by 2 u D. That is 8 u D in all, and its corner_error is twice that, with the start's own
// rounding added.
//
// With R the largest |x| or |y| of the three corners, an edge x1 y2 - y1 x2 is wrong by at most 4 R e + 2 e^2, and rounded by 4 u R^2,
// fused or not. Edges that are certainly of different signs are those of a miss, by exact arithmetic too.
//
// A corner's distance along the ray, z times the inverse of the direction there, is wrong by less than e.
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
#include <limits>
#include <utility>

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
          corner_error(hn::Set(d, ray.corner_error)),
          corner_error_slope(hn::Set(d, ray.corner_error_slope)) {}

    V origin_x, origin_y, origin_z;
    V shear_x, shear_y;
    V inverse_z;
    V corner_error, corner_error_slope;
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
    V corner_error; // e
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
    const V reach_z = hn::Max(hn::Abs(a.z), hn::Max(hn::Abs(b.z), hn::Abs(c.z)));
    const V e = hn::MulAdd(ray.corner_error_slope, hn::Max(reach, reach_z), ray.corner_error);
    // 2^-21 R^2 is twice 4 u R^2, for the rounding of these lines.
    const V quadratic = hn::Mul(hn::Add(e, e), e);
    const V error = hn::MulAdd(reach, hn::MulAdd(hn::Set(d, 4.0f), e, hn::Mul(hn::Set(d, 0x1p-21f), reach)), quadratic);
    return {wa, wb, wc, hn::Max(wa, hn::Max(wb, wc)), hn::Min(wa, hn::Min(wb, wc)), error, e};
}

// Which triangles the line of the ray may hit. A NaN or an infinity, of a ray of which nothing is known, keeps the triangle.
template <class V>
HWY_INLINE auto may_hit(const SignedEdges<V>& edges) {
    return hn::Not(hn::And(hn::Gt(edges.highest, edges.error), hn::Lt(edges.lowest, hn::Neg(edges.error))));
}

// What is known of triangles that may be hit.
template <class D, class V = hn::VFromD<D>>
struct Findings {
    using Mask = decltype(hn::Lt(std::declval<V>(), std::declval<V>()));
    Mask possible;  // a hit in the interval
    Mask certain;   // one even when the interval is shorter by `margin` at both ends
    V lower, upper; // the s of the hit lies between them; rounded by a few u (1 + L)
};

// Of triangles whose edges say may_hit, at an s in [first, last].
//
// The hit is at the mean of the corners' distances, weighted by the edges, which is taken relative to the first corner: x / W there,
// with W the sum of the edges. With w the largest edge and E the edges' error, M the largest difference of distances and e what
// they are wrong by, x is wrong by at most 3 (w e + M E), and rounded by less than 12 u w M; W by 3 E. So with W' = |W| - 4 E, x / W' is
// within (error of x + 8 E |x / W'|) / W' of the hit, where W' is positive. Elsewhere nothing is known.
template <class D, class V = hn::VFromD<D>>
HWY_INLINE Findings<D> find_within(D d, const FilterRay<D>& ray, const SignedEdges<V>& edges,
                                   const ShearedCorners<V>& a, const ShearedCorners<V>& b, const ShearedCorners<V>& c,
                                   V first, V last, V margin) {
    const V sa = hn::Mul(a.z, ray.inverse_z);
    const V db = hn::Sub(hn::Mul(b.z, ray.inverse_z), sa);
    const V dc = hn::Sub(hn::Mul(c.z, ray.inverse_z), sa);
    const V largest = hn::Max(edges.highest, hn::Neg(edges.lowest));
    const V area = hn::Add(edges.a, hn::Add(edges.b, edges.c));
    const V size = hn::NegMulAdd(hn::Set(d, 4.0f), edges.error, hn::Abs(area));
    const V x = hn::Xor(hn::MulAdd(edges.b, db, hn::Mul(edges.c, dc)), hn::And(area, hn::SignBit(d)));
    const V farthest = hn::Max(hn::Abs(db), hn::Abs(dc));
    // More than 12 u M and 3 e; with the error of the edge itself, which is not the largest for certain.
    const V per_edge = hn::MulAdd(farthest, hn::Set(d, 0x1p-20f), hn::Mul(edges.corner_error, hn::Set(d, 3.1f)));
    const V x_error =
        hn::MulAdd(hn::Mul(farthest, edges.error), hn::Set(d, 3.1f), hn::Mul(hn::Add(largest, edges.error), per_edge));
    const V inverse = hn::Div(hn::Set(d, 1.01f), size);
    const V quotient = hn::Mul(x, hn::Mul(inverse, hn::Set(d, 1.0f / 1.01f)));
    const V error = hn::Mul(hn::MulAdd(hn::Mul(edges.error, hn::Set(d, 8.0f)), hn::Abs(quotient), x_error), inverse);
    const V hit = hn::Add(sa, quotient);
    const V lower = hn::Sub(hit, error);
    const V upper = hn::Add(hit, error);

    const auto known = hn::Gt(size, hn::Zero(d));
    const auto outside = hn::Or(hn::Lt(upper, first), hn::Gt(lower, last));
    const auto within = hn::And(hn::Gt(hn::Sub(lower, margin), first), hn::Lt(hn::Add(upper, margin), last));
    const auto edges_certain = hn::Gt(hn::Max(edges.lowest, hn::Neg(edges.highest)), edges.error);
    return {hn::Not(hn::And(known, outside)), hn::And(hn::And(known, edges_certain), within),
            hn::IfThenElse(known, lower, hn::Set(d, -std::numeric_limits<float>::infinity())), upper};
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
