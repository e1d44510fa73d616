#include "geometry/array_checks.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/array_checks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

template <class D, class T = hn::TFromD<D>>
HWY_INLINE hn::VFromD<D> load(D d, const std::byte* numbers, std::uint64_t i) {
    const std::byte* const address = numbers + i * sizeof(T);
#if HWY_TARGET == HWY_SCALAR
    T number;
    std::memcpy(&number, address, sizeof number);
    return hn::Set(d, number);
#else
    const hn::Repartition<std::uint8_t, D> bytes; // which need no alignment
    return hn::BitCast(d, hn::LoadU(bytes, reinterpret_cast<const std::uint8_t*>(address)));
#endif
}

// Four vectors a step, so that none waits for the one before; then the rest, number by number. `block` takes a vector and tells
// the lanes that are wrong, `single` takes a number and tells whether it is right.
template <class D, class Block, class Single>
HWY_INLINE bool all_right(D d, const std::byte* numbers, std::uint64_t count, const Block& block,
                          const Single& single) {
    const std::uint64_t lanes = hn::Lanes(d);
    std::uint64_t i = 0;
    for (; i + 4 * lanes <= count; i += 4 * lanes) {
        const auto low = hn::Or(block(load(d, numbers, i)), block(load(d, numbers, i + lanes)));
        const auto high = hn::Or(block(load(d, numbers, i + 2 * lanes)), block(load(d, numbers, i + 3 * lanes)));
        if (HWY_UNLIKELY(!hn::AllFalse(d, hn::Or(low, high)))) return false;
    }
    for (; i < count; ++i) {
        hn::TFromD<D> number;
        std::memcpy(&number, numbers + i * sizeof number, sizeof number);
        if (!single(number)) return false;
    }
    return true;
}

// What is known of one axis' numbers, or of several's in turn: of each lane.
template <class T>
struct LaneBounds {
    using Lanes = hn::ScalableTag<T>;
    using Vector = hn::Vec<Lanes>;

    Vector lower;
    Vector upper;
    Vector zeros;

    HWY_INLINE LaneBounds()
        : lower(hn::Set(Lanes(), std::numeric_limits<T>::infinity())),
          upper(hn::Neg(lower)),
          zeros(hn::Zero(Lanes())) {}

    HWY_INLINE void add(Vector numbers) {
        lower = hn::Min(lower, numbers);
        upper = hn::Max(upper, numbers);
        zeros = hn::Add(hn::Mul(numbers, hn::Zero(Lanes())), zeros); // a NaN from NaN and infinities, and it stays one
    }

    // first: the axis of the first lane, of which the others follow in turn. Returns whether all numbers were finite.
    HWY_INLINE bool finish(std::size_t first, Box& box) const {
        const Lanes d;
        HWY_ALIGN T lowest[hn::MaxLanes(Lanes())];
        HWY_ALIGN T highest[hn::MaxLanes(Lanes())];
        hn::Store(lower, d, lowest);
        hn::Store(upper, d, highest);
        for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
            const auto axis = static_cast<glm::length_t>((first + i) % 3);
            box.lower[axis] = std::min(box.lower[axis], static_cast<double>(lowest[i]));
            box.upper[axis] = std::max(box.upper[axis], static_cast<double>(highest[i]));
        }
        return hn::AllTrue(d, hn::Eq(zeros, hn::Zero(d)));
    }
};

// Numbers from `begin` up to `end`, one by one. Returns whether all were finite.
template <class T>
HWY_INLINE bool bound_singly(const std::byte* numbers, std::uint64_t begin, std::uint64_t end, Box& box) {
    bool finite = true;
    for (std::uint64_t i = begin; i < end; ++i) {
        T number;
        std::memcpy(&number, numbers + i * sizeof number, sizeof number);
        const auto axis = static_cast<glm::length_t>(i % 3);
        box.lower[axis] = std::min(box.lower[axis], static_cast<double>(number));
        box.upper[axis] = std::max(box.upper[axis], static_cast<double>(number));
        finite = finite && std::isfinite(number);
    }
    return finite;
}

// By whole registers from the first address on that suits them: each number is used three times, and the compiler would rather load it
// three times, from two cache lines each. Three registers hold numbers of each axis in the same lanes again.
template <class T>
HWY_INLINE bool bound_points_of(const std::byte* points, std::uint64_t count, Box& bounds) {
    const hn::ScalableTag<T> d;
    const std::uint64_t lanes = hn::Lanes(d);
    const std::uint64_t numbers = 3 * count;
    const std::uint64_t past = reinterpret_cast<std::uintptr_t>(points) % (lanes * sizeof(T)) / sizeof(T);
    const std::uint64_t first = std::min(numbers, (lanes - past) % lanes);
    LaneBounds<T> a;
    LaneBounds<T> b;
    LaneBounds<T> c;
    std::uint64_t i = first;
    for (; i + 3 * lanes <= numbers; i += 3 * lanes) {
        a.add(load(d, points, i));
        b.add(load(d, points, i + lanes));
        c.add(load(d, points, i + 2 * lanes));
    }
    Box box;
    bool usable = bound_singly<T>(points, 0, first, box);
    usable = bound_singly<T>(points, i, numbers, box) && usable;
    if (i > first) {
        usable = a.finish(first, box) && usable;
        usable = b.finish(first + lanes, box) && usable;
        usable = c.finish(first + 2 * lanes, box) && usable;
    }
    constexpr double most = std::numeric_limits<float>::max();
    for (glm::length_t axis = 0; axis < 3; ++axis)
        usable = usable && !(box.lower[axis] < -most) && !(box.upper[axis] > most);
    if (usable) bounds.extend(box);
    return usable;
}

bool bound_points_kernel(const std::byte* points, std::uint64_t count, bool float64, Box& bounds) {
    return float64 ? bound_points_of<double>(points, count, bounds) : bound_points_of<float>(points, count, bounds);
}

bool below_kernel(const std::byte* indices, std::uint64_t count, std::uint32_t limit) {
    if (limit == 0) return count == 0;
    const hn::ScalableTag<std::uint32_t> d;
    const auto most = hn::Set(d, limit - 1);
    return all_right(
        d, indices, count, [&](auto v) HWY_ATTR { return hn::Ne(hn::Max(v, most), most); },
        [&](std::uint32_t index) { return index < limit; });
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(bound_points_kernel);
HWY_EXPORT(below_kernel);

bool bound_points(const std::byte* points, std::uint64_t count, bool float64, Box& bounds) {
    return HWY_DYNAMIC_DISPATCH(bound_points_kernel)(points, count, float64, bounds);
}
bool all_below(const std::byte* indices, std::uint64_t count, std::uint32_t limit) {
    return HWY_DYNAMIC_DISPATCH(below_kernel)(indices, count, limit);
}

} // namespace raywise
#endif
