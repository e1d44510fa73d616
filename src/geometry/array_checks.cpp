#include "geometry/array_checks.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/array_checks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

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

template <class T>
HWY_INLINE bool within_float32(const std::byte* numbers, std::uint64_t count) {
    constexpr T limit = std::numeric_limits<float>::max();
    const hn::ScalableTag<T> d;
    const auto most = hn::Set(d, limit);
    return all_right(
        d, numbers, count, [&](auto v) HWY_ATTR { return hn::Not(hn::Le(hn::Abs(v), most)); }, // a NaN too
        [](T number) { return number >= -limit && number <= limit; });
}

bool within_float32_kernel(const std::byte* numbers, std::uint64_t count, bool float64) {
    return float64 ? within_float32<double>(numbers, count) : within_float32<float>(numbers, count);
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

HWY_EXPORT(within_float32_kernel);
HWY_EXPORT(below_kernel);

bool all_within_float32(const std::byte* numbers, std::uint64_t count, bool float64) {
    return HWY_DYNAMIC_DISPATCH(within_float32_kernel)(numbers, count, float64);
}
bool all_below(const std::byte* indices, std::uint64_t count, std::uint32_t limit) {
    return HWY_DYNAMIC_DISPATCH(below_kernel)(indices, count, limit);
}

} // namespace raywise
#endif
