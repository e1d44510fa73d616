#include "batch/ray_key.h"

#include <cmath>

// This file is read once for each target, and the kernel compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/ray_key.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Floats = hn::Rebind<float, Doubles>; // as many lanes
using Ints = hn::RebindToSigned<Floats>;
using Keys = hn::RebindToUnsigned<Floats>;
using FloatVector = hn::VFromD<Floats>;
using KeyVector = hn::VFromD<Keys>;

// x in [0, cells) to its cell; anything else to any.
template <std::uint32_t cells>
HWY_INLINE KeyVector cell_of(FloatVector x) {
    const Floats d;
    const FloatVector within = hn::Max(hn::Min(x, hn::Set(d, static_cast<float>(cells - 1))), hn::Zero(d));
    return hn::And(hn::BitCast(Keys(), hn::ConvertTo(Ints(), within)), hn::Set(Keys(), cells - 1)); // of a NaN too
}

// Two zeros behind each of five bits.
HWY_INLINE KeyVector spread(KeyVector bits) {
    static_assert(RayKeys::cell_bits == 5);
    const Keys d;
    bits = hn::And(hn::Or(bits, hn::ShiftLeft<8>(bits)), hn::Set(d, 0x100Fu));
    bits = hn::And(hn::Or(bits, hn::ShiftLeft<4>(bits)), hn::Set(d, 0x10C3u));
    return hn::And(hn::Or(bits, hn::ShiftLeft<2>(bits)), hn::Set(d, 0x1249u));
}

// Answers are the same whatever the keys: they need not be exact. All is in the coordinates of the cells.
void keys_of(const RayKeys& scene, const Ray* rays, std::size_t n, std::uint32_t* keys) {
    const Floats d;
    const Keys dk;
    const Doubles d64;
    const hn::RebindToSigned<Doubles> di64;
    constexpr std::int64_t stride = sizeof(Ray) / sizeof(double);
    static_assert(stride * sizeof(double) == sizeof(Ray));
    const auto indices = hn::Mul(hn::Iota(di64, 0), hn::Set(di64, stride));
    constexpr float cells = 1u << RayKeys::cell_bits;

    for (std::size_t k = 0; k < n; k += hn::Lanes(d64)) {
        FloatVector near = hn::DemoteTo(d, hn::Max(hn::GatherIndex(d64, &rays[k].tmin, indices), hn::Zero(d64)));
        FloatVector start[3];
        FloatVector direction[3];
        FloatVector magnitude[3];
        KeyVector octant = hn::Zero(dk);
        for (int axis = 0; axis < 3; ++axis) {
            const auto per_unit = hn::Set(d64, scene.cells_per_unit()[axis]);
            const auto origin = hn::GatherIndex(d64, &rays[k].origin[axis], indices);
            start[axis] = hn::DemoteTo(d, hn::Mul(hn::Sub(origin, hn::Set(d64, scene.lower()[axis])), per_unit));
            direction[axis] =
                hn::DemoteTo(d, hn::Mul(hn::GatherIndex(d64, &rays[k].direction[axis], indices), per_unit));
            magnitude[axis] = hn::Abs(direction[axis]);
            const auto backwards = hn::Lt(direction[axis], hn::Zero(d));
            const FloatVector plane = hn::IfThenElseZero(backwards, hn::Set(d, cells));
            const FloatVector distance = hn::Div(hn::Sub(plane, start[axis]), direction[axis]);
            near = hn::Max(hn::Min(distance, hn::Set(d, 0x1p100f)), near);
            const KeyVector bit = hn::Set(dk, 1u << axis);
            octant = hn::Or(octant, hn::IfThenElseZero(hn::RebindMask(dk, backwards), bit));
        }
        KeyVector cell = hn::Zero(dk);
        for (int axis = 0; axis < 3; ++axis) {
            const KeyVector along =
                spread(cell_of<1u << RayKeys::cell_bits>(hn::MulAdd(near, direction[axis], start[axis])));
            cell = hn::Or(hn::Add(cell, cell), along); // the last axis has the lowest bit
        }
        constexpr std::uint32_t steps = 1u << RayKeys::direction_bits;
        const FloatVector largest = hn::Max(magnitude[0], hn::Max(magnitude[1], magnitude[2]));
        const FloatVector scale = hn::Div(hn::Set(d, static_cast<float>(steps)), largest);
        const KeyVector pointing =
            hn::Or(hn::ShiftLeft<RayKeys::direction_bits>(cell_of<steps>(hn::Mul(magnitude[0], scale))),
                   cell_of<steps>(hn::Mul(magnitude[1], scale)));
        const KeyVector key = hn::Or(
            hn::ShiftLeft<2 * RayKeys::direction_bits>(hn::Or(hn::ShiftLeft<3 * RayKeys::cell_bits>(octant), cell)),
            pointing);
        hn::StoreU(key, dk, keys + k);
    }
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(keys_of);

RayKeys::RayKeys(const Box& bounds) : lower_(bounds.lower), cells_per_unit_(0.0) {
    for (int axis = 0; axis < 3; ++axis) {
        const double size = bounds.upper[axis] - bounds.lower[axis];
        const double cells = static_cast<double>(1u << cell_bits) / size;
        if (size > 0.0 && std::isfinite(cells)) cells_per_unit_[axis] = cells;
    }
}

void RayKeys::of(const Ray (&rays)[most], std::size_t n, std::uint32_t (&keys)[most]) const {
    HWY_DYNAMIC_DISPATCH(keys_of)(*this, rays, n, keys);
}

} // namespace raywise
#endif
