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

// Numbers of several rays that follow each other, as float32 lanes. In float64 where they are, until they are relative to the scene.
template <class AnyRay>
struct RayLanes;

template <>
struct RayLanes<RayF> {
    using Floats = hn::CappedTag<float, 16>;
    using Vector = hn::VFromD<Floats>;
    static constexpr std::int32_t stride = sizeof(RayF) / sizeof(float);

    // number: of the first ray.
    static HWY_INLINE Vector gather(const float* number) {
        const hn::RebindToSigned<Floats> d;
        return hn::GatherIndex(Floats(), number, hn::Mul(hn::Iota(d, 0), hn::Set(d, stride)));
    }
    // (number - from) * scale
    static HWY_INLINE Vector relative(const float* number, double from, double scale) {
        const Floats d;
        return hn::Mul(hn::Sub(gather(number), hn::Set(d, static_cast<float>(from))),
                       hn::Set(d, static_cast<float>(scale)));
    }
};

template <>
struct RayLanes<Ray> {
    using Doubles = hn::CappedTag<double, 8>;
    using Floats = hn::Rebind<float, Doubles>; // as many lanes
    using Vector = hn::VFromD<Floats>;
    static constexpr std::int64_t stride = sizeof(Ray) / sizeof(double);

    static HWY_INLINE hn::VFromD<Doubles> gather64(const double* number) {
        const hn::RebindToSigned<Doubles> d;
        return hn::GatherIndex(Doubles(), number, hn::Mul(hn::Iota(d, 0), hn::Set(d, stride)));
    }
    static HWY_INLINE Vector gather(const double* number) { return hn::DemoteTo(Floats(), gather64(number)); }
    static HWY_INLINE Vector relative(const double* number, double from, double scale) {
        const Doubles d;
        return hn::DemoteTo(Floats(), hn::Mul(hn::Sub(gather64(number), hn::Set(d, from)), hn::Set(d, scale)));
    }
};

// x in [0, cells) to its cell; anything else to any.
template <std::uint32_t cells, class D>
HWY_INLINE hn::VFromD<hn::RebindToUnsigned<D>> cell_of(D d, hn::VFromD<D> x) {
    const hn::RebindToSigned<D> di;
    const hn::RebindToUnsigned<D> du;
    const auto within = hn::Max(hn::Min(x, hn::Set(d, static_cast<float>(cells - 1))), hn::Zero(d));
    return hn::And(hn::BitCast(du, hn::ConvertTo(di, within)), hn::Set(du, cells - 1)); // of a NaN too
}

// Two zeros behind each of five bits.
template <class V>
HWY_INLINE V spread(V bits) {
    static_assert(RayKeys::cell_bits == 5);
    const hn::DFromV<V> d;
    bits = hn::And(hn::Or(bits, hn::ShiftLeft<8>(bits)), hn::Set(d, 0x100Fu));
    bits = hn::And(hn::Or(bits, hn::ShiftLeft<4>(bits)), hn::Set(d, 0x10C3u));
    return hn::And(hn::Or(bits, hn::ShiftLeft<2>(bits)), hn::Set(d, 0x1249u));
}

// Answers are the same whatever the keys: they need not be exact. All is in the coordinates of the cells.
template <class AnyRay>
HWY_INLINE void make_keys(const RayKeys& scene, const AnyRay* rays, std::size_t n, std::uint32_t* keys) {
    using Lanes = RayLanes<AnyRay>;
    using FloatVector = typename Lanes::Vector;
    using Keys = hn::RebindToUnsigned<typename Lanes::Floats>;
    using KeyVector = hn::VFromD<Keys>;
    const typename Lanes::Floats d;
    const Keys dk;
    static_assert(Lanes::stride * sizeof rays->tmin == sizeof(AnyRay));
    constexpr float cells = 1u << RayKeys::cell_bits;

    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        FloatVector near = hn::Max(Lanes::gather(&rays[k].tmin), hn::Zero(d));
        FloatVector start[3];
        FloatVector direction[3];
        FloatVector magnitude[3];
        KeyVector octant = hn::Zero(dk);
        for (int axis = 0; axis < 3; ++axis) {
            const double per_unit = scene.cells_per_unit()[axis];
            start[axis] = Lanes::relative(&rays[k].origin[axis], scene.lower()[axis], per_unit);
            direction[axis] = Lanes::relative(&rays[k].direction[axis], 0.0, per_unit);
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
                spread(cell_of<1u << RayKeys::cell_bits>(d, hn::MulAdd(near, direction[axis], start[axis])));
            cell = hn::Or(hn::Add(cell, cell), along); // the last axis has the lowest bit
        }
        constexpr std::uint32_t steps = 1u << RayKeys::direction_bits;
        const FloatVector largest = hn::Max(magnitude[0], hn::Max(magnitude[1], magnitude[2]));
        const FloatVector scale = hn::Div(hn::Set(d, static_cast<float>(steps)), largest);
        const KeyVector pointing =
            hn::Or(hn::ShiftLeft<RayKeys::direction_bits>(cell_of<steps>(d, hn::Mul(magnitude[0], scale))),
                   cell_of<steps>(d, hn::Mul(magnitude[1], scale)));
        const KeyVector key = hn::Or(
            hn::ShiftLeft<2 * RayKeys::direction_bits>(hn::Or(hn::ShiftLeft<3 * RayKeys::cell_bits>(octant), cell)),
            pointing);
        hn::StoreU(key, dk, keys + k);
    }
}

void keys_of(const RayKeys& scene, const Ray* rays, std::size_t n, std::uint32_t* keys) {
    make_keys(scene, rays, n, keys);
}
void keys_of_f32(const RayKeys& scene, const RayF* rays, std::size_t n, std::uint32_t* keys) {
    make_keys(scene, rays, n, keys);
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(keys_of);
HWY_EXPORT(keys_of_f32);

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
void RayKeys::of(const RayF (&rays)[most], std::size_t n, std::uint32_t (&keys)[most]) const {
    HWY_DYNAMIC_DISPATCH(keys_of_f32)(*this, rays, n, keys);
}

} // namespace raywise
#endif
