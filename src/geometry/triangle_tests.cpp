#include "geometry/triangle_tests.h"

// This file is read once for each target, and the kernel compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/triangle_tests.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Bits = hn::RebindToUnsigned<Doubles>;
using Answers = hn::RebindToSigned<Doubles>;
using Vector = hn::VFromD<Doubles>;
using Mask = decltype(hn::Lt(Vector(), Vector()));

HWY_INLINE Vector constant(double value) { return hn::Set(Doubles(), value); }
HWY_INLINE Vector largest(Vector a, Vector b, Vector c) { return hn::Max(hn::Max(a, b), c); }
HWY_INLINE Vector smallest(Vector a, Vector b, Vector c) { return hn::Min(hn::Min(a, b), c); }
HWY_INLINE Mask all_of(Mask a, Mask b, Mask c) { return hn::And(hn::And(a, b), c); }

// A direction's power of two, as RayUnit; where it is none that can be multiplied with, is_plain is false.
struct Unit {
    Vector unit;
    Vector inverse;
    Mask is_plain;
};

HWY_INLINE Unit unit_of(Vector largest_component) {
    const Bits b;
    constexpr std::uint64_t middle = 1023;
    const auto exponent = hn::ShiftRight<52>(hn::BitCast(b, largest_component));
    const auto inverse = hn::Sub(hn::Set(b, 2 * middle), exponent);
    return {hn::BitCast(Doubles(), hn::ShiftLeft<52>(exponent)), hn::BitCast(Doubles(), hn::ShiftLeft<52>(inverse)),
            hn::And(hn::Ge(largest_component, constant(0x1p-1000)), hn::Lt(largest_component, constant(0x1p1001)))};
}

// What becomes of a component of the direction; see PreparedRay::smallest_direction.
HWY_INLINE Vector component(Vector direction, const Unit& unit) {
    const Vector scaled = hn::Mul(direction, unit.inverse);
    const Mask small = hn::Lt(hn::Abs(scaled), constant(PreparedRay::smallest_direction));
    return hn::IfThenElse(small, hn::And(scaled, hn::SignBit(Doubles())), scaled);
}

// A corner relative to the origin, and sheared.
struct Corner {
    Vector dx, dy, z;
    Vector x, y;

    HWY_INLINE Vector largest_component() const { return largest(hn::Abs(dx), hn::Abs(dy), hn::Abs(z)); }
};

HWY_INLINE Vector edge(const Corner& p, const Corner& q) { return hn::Sub(hn::Mul(p.x, q.y), hn::Mul(p.y, q.x)); }

// See triangle_test.h for all of it. A lane in which something is beyond numbers is unknown, or unwanted.
void test_triangles(TriangleTests::Lanes& lanes, std::size_t n) {
    const Doubles d;
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const auto load = [&](const double* values) HWY_ATTR { return hn::Load(d, values + k); };

        const Vector major = load(lanes.direction[2]);
        const Unit unit = unit_of(hn::Abs(major));
        const Vector inverse_z = hn::Div(constant(1.0), component(major, unit));
        const Vector shear_x = hn::Mul(component(load(lanes.direction[0]), unit), inverse_z);
        const Vector shear_y = hn::Mul(component(load(lanes.direction[1]), unit), inverse_z);
        const Vector callers_tmin = load(lanes.tmin);
        const Vector callers_tmax = load(lanes.tmax);
        const Vector tmin = hn::Mul(callers_tmin, unit.unit);
        const Vector tmax =
            hn::Min(hn::Mul(callers_tmax, unit.unit), hn::Mul(constant(std::numeric_limits<double>::max()), unit.unit));
        const Mask interval_grows = hn::Or(hn::Lt(hn::Mul(tmin, unit.inverse), callers_tmin),
                                           hn::Gt(hn::Mul(tmax, unit.inverse), callers_tmax));

        const auto shear = [&](std::size_t corner) HWY_ATTR {
            const Vector dx = hn::Sub(load(lanes.corner[corner][0]), load(lanes.origin[0]));
            const Vector dy = hn::Sub(load(lanes.corner[corner][1]), load(lanes.origin[1]));
            const Vector z = hn::Sub(load(lanes.corner[corner][2]), load(lanes.origin[2]));
            return Corner{dx, dy, z, hn::Sub(dx, hn::Mul(shear_x, z)), hn::Sub(dy, hn::Mul(shear_y, z))};
        };
        const Corner a = shear(0);
        const Corner b = shear(1);
        const Corner c = shear(2);
        const Vector wa = edge(b, c);
        const Vector wb = edge(c, a);
        const Vector wc = edge(a, b);

        const Vector farthest = largest(a.largest_component(), b.largest_component(), c.largest_component());
        Vector reach = hn::Add(hn::Abs(a.x), hn::Abs(a.y));
        reach = hn::Add(hn::Add(reach, hn::Abs(b.x)), hn::Abs(b.y));
        reach = hn::Add(hn::Add(reach, hn::Abs(c.x)), hn::Abs(c.y));
        const Vector shear_error = hn::Mul(constant(0x1p-50), farthest);
        const Vector error =
            hn::Add(hn::Mul(hn::Mul(constant(1.01), shear_error), hn::Add(reach, hn::Mul(constant(2.0), shear_error))),
                    hn::Mul(hn::Mul(constant(0x1p-51), reach), reach));
        const Mask in_range = hn::And(hn::Gt(farthest, constant(0x1p-400)), hn::Lt(farthest, constant(0x1p400)));
        const Mask misses =
            all_of(in_range, hn::Gt(largest(wa, wb, wc), error), hn::Lt(smallest(wa, wb, wc), hn::Neg(error)));

        const Vector z_low = smallest(a.z, b.z, c.z);
        const Vector z_high = largest(a.z, b.z, c.z);
        const Mask signs_certain = hn::Gt(smallest(hn::Abs(wa), hn::Abs(wb), hn::Abs(wc)), error);
        const Vector sum = hn::Add(hn::Add(wa, wb), wc);
        const Vector area = hn::Abs(sum);
        const Vector weight_error = hn::Mul(constant(3.0), error);
        const Mask weights_certain = hn::And(
            hn::Le(hn::Mul(weight_error, constant(0x1p30)), area),
            hn::Le(hn::Mul(hn::Mul(weight_error, hn::Sub(z_high, z_low)), constant(0x1p40)), hn::Mul(area, farthest)));

        const Vector u = hn::Div(wb, sum);
        const Vector v = hn::Div(wc, sum);
        const Vector mean = hn::Add(a.z, hn::Add(hn::Mul(u, hn::Sub(b.z, a.z)), hn::Mul(v, hn::Sub(c.z, a.z))));
        const Vector z = hn::IfThenElse(hn::Lt(mean, z_low), z_low, hn::IfThenElse(hn::Lt(z_high, mean), z_high, mean));
        const Vector z_error = hn::Mul(constant(0x1p-38), farthest);
        const Mask around_origin = hn::And(hn::Le(z_low, constant(0.0)), hn::Ge(z_high, constant(0.0)));
        const Mask near_origin =
            all_of(around_origin, hn::Le(hn::Abs(z), z_error), hn::Le(tmin, hn::Mul(constant(2.0), z_error)));
        const Vector t = hn::Add(hn::Mul(hn::Mul(hn::Mul(z, inverse_z), unit.inverse), unit.unit), constant(0.0));

        const Mask certain = hn::AndNot(hn::Or(near_origin, interval_grows),
                                        hn::And(all_of(in_range, signs_certain, weights_certain), unit.is_plain));
        const Mask within = hn::And(hn::Le(tmin, t), hn::Le(t, tmax));
        const Answers da;
        const auto answer_of = [&](TriangleTests::Answer answer)
                                   HWY_ATTR { return hn::Set(da, static_cast<std::int64_t>(answer)); };
        const auto of_certain = hn::IfThenElse(hn::RebindMask(da, within), answer_of(TriangleTests::Answer::hits),
                                               answer_of(TriangleTests::Answer::misses));
        const auto of_others =
            hn::IfThenElse(hn::RebindMask(da, hn::And(misses, unit.is_plain)), answer_of(TriangleTests::Answer::misses),
                           answer_of(TriangleTests::Answer::unknown));
        hn::Store(hn::IfThenElse(hn::RebindMask(da, hn::AndNot(misses, certain)), of_certain, of_others), da,
                  lanes.answer + k);
        hn::Store(t, d, lanes.t + k);
        hn::Store(hn::Add(u, constant(0.0)), d, lanes.u + k);
        hn::Store(hn::Add(v, constant(0.0)), d, lanes.v + k);
    }
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(test_triangles);

void TriangleTests::run() { HWY_DYNAMIC_DISPATCH(test_triangles)(lanes_, size_); }

} // namespace raywise
#endif
