// The questions to a Tracer. Single rays come in two precisions and are answered in one: float32
// counts as float64, and the answers are rounded.
#pragma once

#include "convert.h"
#include "guard.h"

namespace raywise::capi {

// For a ray with options.
template <class AnyRay>
Hit closest_with(const Tracer& tracer, const AnyRay& ray, const rw_ray_options& options);
template <class AnyRay>
bool any_with(const Tracer& tracer, const AnyRay& ray, const rw_ray_options& options);
// options: may be NULL.
std::vector<Hit> all_with(const Tracer& tracer, const Ray& ray, const rw_ray_options* options);

Error over_capacity(std::uint64_t needed, std::uint64_t capacity);

template <class CallersRay, class CallersHit>
void intersect(const Tracer& tracer, const CallersRay* ray, const rw_ray_options* options, CallersHit* hit) {
    const auto& r = read_ray(ray);
    CallersHit& out = required(hit, "hit");
    write_hit(options == nullptr ? tracer.closest(r) : closest_with(tracer, r, *options), out);
}

template <class CallersRay>
void occluded(const Tracer& tracer, const CallersRay* ray, const rw_ray_options* options, std::int32_t* answer) {
    const auto& r = read_ray(ray);
    std::int32_t& out = required(answer, "occluded");
    out = (options == nullptr ? tracer.any(r) : any_with(tracer, r, *options)) ? 1 : 0;
}

template <class CallersRay, class CallersHit>
void intersect_all(const Tracer& tracer, const CallersRay* ray, const rw_ray_options* options, CallersHit* hits,
                   std::uint64_t capacity, std::uint64_t* needed) {
    const auto& r = read_ray(ray);
    std::uint64_t& count = required(needed, "needed");
    if (hits == nullptr && capacity > 0) throw null_argument("hits");
    const std::vector<Hit> found = all_with(tracer, widened(r), options);
    count = found.size();
    for (std::size_t i = 0; i < std::min<std::uint64_t>(capacity, found.size()); ++i) write_hit(found[i], hits[i]);
    if (hits != nullptr && found.size() > capacity) throw over_capacity(found.size(), capacity);
}

// Of the triangle with the ids of a hit, which come from the caller.
Vec3 checked_normal(const Tracer& tracer, std::uint32_t instance, std::uint32_t geometry, std::uint32_t primitive);

template <class CallersHit, class Number>
void normal(const Tracer& tracer, const CallersHit* hit, Number* normal) {
    const CallersHit& h = required(hit, "hit");
    required(normal, "normal");
    const Vec3 n = checked_normal(tracer, h.instance, h.geometry, h.primitive);
    for (int axis = 0; axis < 3; ++axis) normal[axis] = static_cast<Number>(n[axis]);
}

void intersect_batch(const Tracer& tracer, const rw_rays* rays, const rw_hits* hits, const rw_query_options* options);
void occluded_batch(const Tracer& tracer, const rw_rays* rays, const rw_output* answers,
                    const rw_query_options* options);
void intersect_all_batch(const Tracer& tracer, const rw_rays* rays, std::uint64_t* offsets, const rw_hits* hits,
                         std::uint64_t capacity, std::uint64_t* needed, const rw_query_options* options);

} // namespace raywise::capi
