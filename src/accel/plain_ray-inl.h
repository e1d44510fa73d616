// From the caller's ray to a PlainRay. For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_PLAIN_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_PLAIN_RAY_INL_H_
#undef RAYWISE_ACCEL_PLAIN_RAY_INL_H_
#else
#define RAYWISE_ACCEL_PLAIN_RAY_INL_H_
#endif

#include "accel/plain_ray.h"
#include "accel/scene_frame.h"

#include <hwy/highway.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#undef RAYWISE_FOUR_DOUBLES
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
#define RAYWISE_FOUR_DOUBLES 1
#else
#define RAYWISE_FOUR_DOUBLES 0
#endif

// A ray that starts far from the scene is moved to where it enters the frame.
HWY_INLINE bool move_to_frame(const Vec3& direction, Vec3& start, double& moved) {
    double entry = -0x1p1000;
    for (int axis = 0; axis < 3; ++axis) {
        const double along = direction[axis];
        if (std::fabs(along) < static_cast<double>(PlainRay::smallest_direction)) continue;
        entry = larger(entry, (std::copysign(1.0, -along) - start[axis]) / along);
    }
    start += entry * direction;
    moved = entry;
    return max_component(magnitudes(start)) <= PlainRay::reach; // or it does not come near the scene
}

HWY_INLINE bool has_plain_exponent(double power_of_two) {
    std::uint64_t bits;
    std::memcpy(&bits, &power_of_two, sizeof bits);
    constexpr int middle = 1023;
    return (bits >> 52) - (middle - PlainRay::largest_exponent) <= 2 * PlainRay::largest_exponent;
}

HWY_INLINE void set_interval(const Ray& ray, double unit, float bound, PlainRayPlace& place, PlainRay& result) {
    result.bound = bound;
    place.half_margin = PlainRay::half_margin * bound;
    result.first = place.first(ray.tmin * unit);
    result.last = place.last(ray.tmax * unit);
}

#if RAYWISE_FOUR_DOUBLES

using Doubles = hn::Full256<double>;
using Floats = hn::Full128<float>;

HWY_INLINE std::uint32_t bits_of_axes(hn::MFromD<Doubles> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Doubles(), mask, bytes);
    return bytes[0];
}

HWY_INLINE void set_directions(hn::VFromD<Doubles> start64, hn::VFromD<Doubles> direction64, float bound,
                               PlainRay& result) {
    const Floats f;
    const auto start = hn::DemoteTo(f, start64);
    const auto direction = hn::DemoteTo(f, direction64);
    const auto magnitude = hn::Max(hn::Abs(direction), hn::Set(f, PlainRay::smallest_direction));
    const auto inverse = hn::CopySign(hn::Div(hn::Set(f, 1.0f), magnitude), direction);
    const auto shift = hn::CopySign(hn::Set(f, PlainRay::shift * bound), direction);
    hn::Store(inverse, f, result.inverse);
    hn::Store(hn::MulAdd(hn::Add(start, shift), inverse, hn::Set(f, PlainRay::half_margin * bound)), f,
              result.entry_offset);
    hn::Store(start, f, result.start);
    hn::Store(direction, f, result.direction);
    std::uint8_t negative[8] = {};
    hn::StoreMaskBits(f, hn::Lt(inverse, hn::Zero(f)), negative);
    result.octant = static_cast<std::uint8_t>(negative[0] & 7u);
}

// The members are written where they are to be: a ray that was just written takes long to copy.
HWY_INLINE PlainRayStatus set_plain_ray(const Ray& ray, const SceneFrame& frame, PlainRay& result,
                                        PlainRayPlace& place) {
    const Doubles d;
    const hn::RebindToUnsigned<Doubles> du;
    static_assert(offsetof(Ray, tmin) == offsetof(Ray, origin) + 24 &&
                  offsetof(Ray, tmax) == offsetof(Ray, direction) + 24);
    alignas(32) static constexpr std::uint64_t axes_of_magnitude[4] = {~std::uint64_t{0} >> 1, ~std::uint64_t{0} >> 1,
                                                                       ~std::uint64_t{0} >> 1, 0};
    const auto magnitude_bits =
        hn::BitCast(d, hn::Load(du, axes_of_magnitude)); // and no fourth: tmin and tmax go along unused
    const auto direction = hn::LoadU(d, &ray.direction.x);
    const auto magnitude = hn::And(direction, magnitude_bits);
    const auto of_pairs = hn::Max(magnitude, hn::Shuffle01(magnitude));
    const auto largest = hn::Max(of_pairs, hn::SwapAdjacentBlocks(of_pairs)); // in all lanes
    const auto unit_bits = hn::And(hn::BitCast(du, largest), hn::Set(du, std::uint64_t{0x7FF} << 52));
    const auto inverse_unit = hn::BitCast(d, hn::Sub(hn::Set(du, std::uint64_t{0x7FE} << 52), unit_bits));
    const double unit = hn::GetLane(hn::BitCast(d, unit_bits));

    auto start =
        hn::Mul(hn::Sub(hn::LoadU(d, &ray.origin.x), hn::LoadU(d, frame.center4())), hn::Set(d, frame.scale()));
    const auto start_magnitude = hn::And(start, magnitude_bits);
    const auto is_number = hn::Le(magnitude, largest); // in all three, or one is none
    if (HWY_UNLIKELY(bits_of_axes(hn::And(is_number, hn::Le(start_magnitude, hn::Set(d, PlainRay::farthest)))) != 15u ||
                     !has_plain_exponent(unit) || !(ray.tmin <= ray.tmax)))
        return PlainRayStatus::odd;

    const auto scaled = hn::Mul(direction, inverse_unit);
    place.scale = frame.scale();
    place.start = 0.0;
    float bound = 1.0f;
    if (HWY_LIKELY(bits_of_axes(hn::Le(start_magnitude, hn::Set(d, 1.0))) == 15u)) {
        bound = PlainRay::within_frame;
    } else if (HWY_UNLIKELY(bits_of_axes(hn::Le(start_magnitude, hn::Set(d, PlainRay::reach))) != 15u)) {
        HWY_ALIGN double start_of[4];
        HWY_ALIGN double direction_of[4];
        hn::Store(start, d, start_of);
        hn::Store(scaled, d, direction_of);
        Vec3 moved{start_of[0], start_of[1], start_of[2]};
        if (!move_to_frame({direction_of[0], direction_of[1], direction_of[2]}, moved, place.start))
            return PlainRayStatus::misses;
        HWY_ALIGN const double moved_to[4] = {moved.x, moved.y, moved.z, 0.0};
        start = hn::Load(d, moved_to);
    }
    set_directions(start, scaled, bound, result);
    result.major_axis = static_cast<std::uint8_t>(__builtin_ctz(bits_of_axes(hn::Eq(magnitude, largest))));
    set_interval(ray, unit, bound, place, result);
    return PlainRayStatus::plain;
}

#else

HWY_INLINE PlainRayStatus set_plain_ray(const Ray& ray, const SceneFrame& frame, PlainRay& result,
                                        PlainRayPlace& place) {
    const MajorAxis major(ray.direction);
    Vec3 start = frame.to_frame(ray.origin);
    const double far = max_component(magnitudes(start));
    // A NaN in the direction is a NaN in the sum; infinity was seen by then.
    if (!(far <= PlainRay::farthest) || !has_plain_exponent(major.magnitude) || !(ray.tmin <= ray.tmax) ||
        std::isnan(ray.direction.x + ray.direction.y + ray.direction.z + start.x + start.y + start.z))
        return PlainRayStatus::odd;
    const RayUnit unit(major.magnitude);
    const Vec3 direction = ray.direction * unit.inverse_unit();
    place.scale = frame.scale();
    place.start = 0.0;
    const float bound = far <= 1.0 ? PlainRay::within_frame : 1.0f;
    if (far > PlainRay::reach && !move_to_frame(direction, start, place.start)) return PlainRayStatus::misses;
    result.octant = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto along = static_cast<float>(direction[axis]);
        const float magnitude = std::fmax(std::fabs(along), PlainRay::smallest_direction);
        const float inverse = std::copysign(1.0f / magnitude, along);
        const auto from = static_cast<float>(start[axis]);
        result.inverse[axis] = inverse;
        result.entry_offset[axis] =
            (from + std::copysign(PlainRay::shift * bound, along)) * inverse + PlainRay::half_margin * bound;
        result.start[axis] = from;
        result.direction[axis] = along;
        if (inverse < 0.0f) result.octant |= static_cast<std::uint8_t>(1u << axis);
    }
    result.major_axis = static_cast<std::uint8_t>(major.axis);
    set_interval(ray, unit.unit(), bound, place, result);
    return PlainRayStatus::plain;
}

#endif

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
