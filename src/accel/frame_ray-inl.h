// A FrameRay in a tenth of a microsecond less: nearly all rays begin within 4 of the middle of the scene, and for those its numbers
// are had by a few vector instructions from the caller's ray, without preparing it.
//
// The bounds are those of frame_ray.h for L = 4, which makes them constants: `shift` 2^-18, `margin` 2^-15 where 5 * 2^-18 is asked
// for, and as much for PreparedRay's margin, which is below 5 * 2^-34 here; `corner_error` 1.5 * 2^-18 where 5 * 2^-20 is asked for.
// All is computed in float32 from where the start and the scaled direction are rounded to it: the offsets are rounded twice more than
// there, by 2 u L in all, the shear by 3 u instead of u; both bounds had more to spare.
//
// For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_FRAME_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_FRAME_RAY_INL_H_
#undef RAYWISE_ACCEL_FRAME_RAY_INL_H_
#else
#define RAYWISE_ACCEL_FRAME_RAY_INL_H_
#endif

#include "accel/frame_ray.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// All fill a ray in place: one that was just written takes long to copy.
HWY_INLINE void set_frame_ray(const PreparedRay& ray, const SceneFrame& frame, FrameRay& result) {
    result = FrameRay(ray, frame);
}

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL

HWY_INLINE void set_frame_ray(const UnpreparedRay& unprepared, const SceneFrame& frame, FrameRay& result) {
    const hn::Full256<double> d;
    const hn::Full128<float> f;
    const Ray& ray = unprepared.ray;
    static_assert(offsetof(Ray, tmin) == offsetof(Ray, origin) + 24 &&
                  offsetof(Ray, tmax) == offsetof(Ray, direction) + 24);
    const auto origin = hn::LoadU(d, &ray.origin.x); // and tmin, which goes along unused; likewise below
    const auto direction = hn::LoadU(d, &ray.direction.x);

    const MajorAxis major(ray.direction);
    const RayUnit unit(major.magnitude);
    const auto start = hn::Mul(hn::Sub(origin, hn::LoadU(d, frame.center4())), hn::Set(d, frame.scale()));
    std::uint8_t near[8] = {};
    hn::StoreMaskBits(d, hn::Le(hn::Abs(start), hn::Set(d, 4.0)), near);
    // Beyond 2^100 t may be rounded coarsely: see PreparedRay.
    if (HWY_UNLIKELY((near[0] & 7u) != 7u || std::abs(unit.exponent()) > 100)) {
        set_frame_ray(unprepared.prepare(), frame, result);
        return;
    }

    constexpr double margin = 0x1p-15;
    result.begin_at_origin(frame.scale(), margin);
    const auto scaled = hn::Mul(direction, hn::Set(d, unit.inverse_unit()));
    const auto limit = hn::Set(d, 0x1p60);
    const auto inverse64 = hn::Max(hn::Min(hn::Div(hn::Set(d, 1.0), scaled), limit), hn::Neg(limit));
    const auto inverse = hn::DemoteTo(f, inverse64);
    const auto start32 = hn::DemoteTo(f, start);
    const auto shift = hn::CopySignToAbs(hn::Set(f, 0x1p-18f), inverse);
    const auto half_margin = hn::Set(f, static_cast<float>(0.5 * margin));
    hn::Store(inverse, f, result.inverse);
    hn::Store(hn::MulAdd(hn::Add(start32, shift), inverse, half_margin), f, result.entry_offset);
    hn::Store(hn::MulSub(hn::Sub(start32, shift), inverse, half_margin), f, result.exit_offset);
    std::uint8_t negative[8] = {};
    hn::StoreMaskBits(f, hn::Lt(inverse, hn::Zero(f)), negative);
    result.backwards = negative[0] & 7u;
    result.set_interval(unit.from_caller(ray.tmin), unit.from_caller(ray.tmax));

    HWY_ALIGN float start_of[4];
    HWY_ALIGN float direction_of[4];
    hn::Store(start32, f, start_of);
    hn::Store(hn::DemoteTo(f, scaled), f, direction_of);
    result.z_axis = major.axis;
    result.x_axis = major.axis == 2 ? 0 : major.axis + 1;
    result.y_axis = result.x_axis == 2 ? 0 : result.x_axis + 1;
    result.origin_x = start_of[result.x_axis];
    result.origin_y = start_of[result.y_axis];
    result.origin_z = start_of[result.z_axis];
    result.inverse_z = result.inverse[result.z_axis];
    result.shear_x = direction_of[result.x_axis] * result.inverse_z;
    result.shear_y = direction_of[result.y_axis] * result.inverse_z;
    result.corner_error = 0x1.8p-18f;
}

#else

HWY_INLINE void set_frame_ray(const UnpreparedRay& ray, const SceneFrame& frame, FrameRay& result) {
    set_frame_ray(ray.prepare(), frame, result);
}

#endif

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
