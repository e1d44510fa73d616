// From the caller's ray to a TraversalRay. For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_RAY_TRAVERSAL_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_RAY_TRAVERSAL_RAY_INL_H_
#undef RAYWISE_RAY_TRAVERSAL_RAY_INL_H_
#else
#define RAYWISE_RAY_TRAVERSAL_RAY_INL_H_
#endif

#include "ray/traversal_ray.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL

using Doubles = hn::Full256<double>;
using Floats = hn::Full128<float>;

HWY_INLINE std::uint32_t bits_of_axes(hn::MFromD<Doubles> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Doubles(), mask, bytes);
    return bytes[0];
}

HWY_INLINE hn::VFromD<Doubles> load_four(const double* numbers) { return hn::LoadU(Doubles(), numbers); }
HWY_INLINE hn::VFromD<Doubles> load_four(const float* numbers) {
    return hn::PromoteTo(Doubles(), hn::LoadU(Floats(), numbers));
}

// Whether components of a direction stay what they are in float32, and their inverses numbers: below 2^-126 they would lose bits, and below
// 2^-128 have no inverse, however large they are beside a length that is as small. NaN is false.
template <class D, class V = hn::VFromD<D>>
HWY_INLINE hn::MFromD<D> are_float_numbers(D d, V magnitude) {
    using T = hn::TFromD<D>;
    return hn::Or(hn::Eq(magnitude, hn::Zero(d)), hn::Ge(magnitude, hn::Set(d, static_cast<T>(0x1p-126f))));
}

// What is the same once a ray is in the frame. along: its direction, of any length; inverse_scale: from the inverses of its components to those
// of the scaled direction.
// The members are stored as they are made, 16 bytes at a time, and read back no wider: reading across stores would wait for them to reach
// the cache (a store-forwarding stall).
HWY_INLINE void set_axes(hn::VFromD<Floats> start, hn::VFromD<Floats> along, hn::VFromD<Floats> inverse_scale,
                         TraversalRay& result) {
    const Floats f;
    const auto unscaled = hn::Div(hn::Set(f, 1.0f), hn::Abs(along));
    const auto magnitude =
        hn::Min(hn::Mul(unscaled, inverse_scale), hn::Set(f, 1.0f / TraversalRay::smallest_direction));
    const auto inverse = hn::CopySign(magnitude, along);
    const auto offset = hn::Mul(start, inverse);
    const auto slack = hn::Mul(hn::Abs(offset), hn::Set(f, TraversalRay::offset_slack));
    hn::Store(inverse, f, result.inverse);
    hn::Store(hn::Add(offset, slack), f, result.entry_offset);
    hn::Store(hn::Sub(offset, slack), f, result.exit_offset);
    hn::Store(along, f, result.direction);
    std::uint8_t backwards[8] = {};
    hn::StoreMaskBits(f, hn::Lt(inverse, hn::Zero(f)), backwards);
    result.octant = backwards[0] & 7u;
}

template <class AnyRay>
HWY_INLINE RaySetup set_up_in_double(const AnyRay& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time) {
    const Doubles d;
    const Floats f;
    const hn::RebindToUnsigned<Doubles> du;
    static_assert(offsetof(AnyRay, tmin) == offsetof(AnyRay, origin) + 3 * sizeof ray.tmin &&
                  offsetof(AnyRay, tmax) == offsetof(AnyRay, direction) + 3 * sizeof ray.tmax);
    // Of x, y and z; tmin and tmax go along in the fourth lanes.
    alignas(32) static constexpr std::uint64_t axes_of_magnitude[4] = {~std::uint64_t{0} >> 1, ~std::uint64_t{0} >> 1,
                                                                       ~std::uint64_t{0} >> 1, 0};
    const auto magnitude_bits = hn::BitCast(d, hn::Load(du, axes_of_magnitude));
    const auto direction = load_four(&ray.direction.x);
    const auto magnitude = hn::And(direction, magnitude_bits);
    const auto of_pairs = hn::Max(magnitude, hn::Shuffle01(magnitude));
    const auto largest = hn::Max(of_pairs, hn::SwapAdjacentBlocks(of_pairs)); // in all lanes
    const auto offset = hn::Sub(load_four(&ray.origin.x), hn::LoadU(d, frame.center4()));
    const auto offset_magnitude = hn::And(offset, magnitude_bits);
    const auto distance_of_pairs = hn::Max(offset_magnitude, hn::Shuffle01(offset_magnitude));
    const auto distance = hn::Max(distance_of_pairs, hn::SwapAdjacentBlocks(distance_of_pairs));
    const auto scale = hn::Set(d, frame.scale());
    const auto start = hn::Mul(offset, scale);
    // Comparisons with NaN are false: such a ray goes the long way too.
    const auto is_usual = hn::And(
        hn::And(are_float_numbers(d, magnitude), hn::Le(hn::And(start, magnitude_bits), hn::Set(d, frame.near()))),
        hn::And(hn::Ge(largest, hn::Set(d, 0x1p-100)), hn::Le(largest, hn::Set(d, 0x1p100))));
    if (HWY_UNLIKELY(bits_of_axes(is_usual) != 15u || !(ray.tmin <= ray.tmax)))
        return set_up_rare_ray(widened(ray), frame, result, time);

    const auto length_bits = hn::And(hn::BitCast(du, largest), hn::Set(du, std::uint64_t{0x7FF} << 52));
    const auto length = hn::BitCast(d, length_bits);
    time.length = hn::GetLane(length);
    time.scale = time.length * frame.scale();
    time.moved = 0.0;
    time.error = 0.0;
    time.origin_distance = hn::GetLane(distance);

    // The division does not wait for the scale of the direction, which is a power of two: it comes after.
    set_axes(hn::DemoteTo(f, start), hn::DemoteTo(f, direction), hn::DemoteTo(f, length), result);
    result.first = RayTime::clamped(static_cast<double>(ray.tmin) * time.scale);
    result.last = RayTime::clamped(static_cast<double>(ray.tmax) * time.scale);
    return RaySetup::ready;
}

HWY_INLINE RaySetup set_up_ray(const Ray& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time) {
    return set_up_in_double(ray, frame, result, time);
}

// All in float32, where the frame allows it: the steps of set_up_in_double, each of them exact but those of set_axes. What underflows is less
// than boxes are wider by.
HWY_INLINE RaySetup set_up_ray(const RayF& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time) {
    const Floats f;
    const hn::RebindToUnsigned<Floats> fu;
    if (HWY_UNLIKELY(frame.float_scale() == 0.0f)) return set_up_in_double(ray, frame, result, time);
    // Of x, y and z; tmin and tmax go along in the fourth lanes.
    alignas(16) static constexpr std::uint32_t axes_of_magnitude[4] = {~0u >> 1, ~0u >> 1, ~0u >> 1, 0};
    const auto magnitude_bits = hn::BitCast(f, hn::Load(fu, axes_of_magnitude));
    const auto largest_of = [&](hn::VFromD<Floats> magnitude) HWY_ATTR { // in all lanes
        const auto of_pairs = hn::Max(magnitude, hn::Shuffle1032(magnitude));
        return hn::Max(of_pairs, hn::Shuffle2301(of_pairs));
    };
    const auto direction = hn::LoadU(f, &ray.direction.x);
    const auto magnitude = hn::And(direction, magnitude_bits);
    const auto largest = largest_of(magnitude);
    const auto origin = hn::LoadU(f, &ray.origin.x);
    const auto scale = hn::Set(f, frame.float_scale());
    const auto start = hn::Mul(origin, scale);
    // Comparisons with NaN are false: such a ray goes the long way too.
    const auto near = hn::Set(f, static_cast<float>(frame.near()));
    const auto is_usual =
        hn::And(hn::And(are_float_numbers(f, magnitude), hn::Le(hn::And(start, magnitude_bits), near)),
                hn::And(hn::Ge(largest, hn::Set(f, 0x1p-60f)), hn::Le(largest, hn::Set(f, 0x1p60f))));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(f, is_usual, bits);
    if (HWY_UNLIKELY((bits[0] & 15u) != 15u || !(ray.tmin <= ray.tmax)))
        return set_up_rare_ray(widened(ray), frame, result, time);

    const auto length = hn::BitCast(f, hn::And(hn::BitCast(fu, largest), hn::Set(fu, 0xFFu << 23)));
    time.length = static_cast<double>(hn::GetLane(length));
    time.scale = time.length * frame.scale();
    time.moved = 0.0;
    time.error = 0.0;
    time.origin_distance = static_cast<double>(hn::GetLane(largest_of(hn::And(origin, magnitude_bits))));
    set_axes(start, direction, length, result);
    const auto time_scale = hn::Mul(scale, length);
    const auto most = hn::Set(f, std::numeric_limits<float>::max());
    const auto in_s = [&](hn::VFromD<Floats> t) HWY_ATTR { // of the fourth lane
        return hn::GetLane(hn::Clamp(hn::Mul(hn::Broadcast<3>(t), time_scale), hn::Neg(most), most));
    };
    result.first = in_s(origin);
    result.last = in_s(direction);
    return RaySetup::ready;
}

#else

template <class AnyRay>
HWY_INLINE RaySetup set_up_ray(const AnyRay& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time) {
    return set_up_rare_ray(widened(ray), frame, result, time);
}

#endif

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
