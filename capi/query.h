// The questions, once for scenes and views: both hand over their Tracer.
#pragma once

#include "convert.h"
#include "guard.h"

namespace raywise::capi {

inline void intersect(const Tracer& tracer, const rw_ray* ray, rw_hit* hit) {
    const Ray& r = read_ray(ray);
    rw_hit& out = required(hit, "hit");
    write_hit(tracer.closest(r), out);
}

inline void occluded(const Tracer& tracer, const rw_ray* ray, std::int32_t* answer) {
    const Ray& r = read_ray(ray);
    required(answer, "occluded") = tracer.any(r) ? 1 : 0;
}

void intersect_with(const Tracer& tracer, const rw_ray* ray, const rw_ray_options* options, rw_hit* hit);
void occluded_with(const Tracer& tracer, const rw_ray* ray, const rw_ray_options* options, std::int32_t* answer);
void intersect_all_with(const Tracer& tracer, const rw_ray* ray, const rw_ray_options* options, rw_hit* hits,
                        std::uint64_t capacity, std::uint64_t* needed);
void intersect_batch(const Tracer& tracer, const rw_rays* rays, const rw_hits* hits, const rw_query_options* options);
void occluded_batch(const Tracer& tracer, const rw_rays* rays, const rw_output* answers,
                    const rw_query_options* options);
void intersect_all_batch(const Tracer& tracer, const rw_rays* rays, std::uint64_t* offsets, const rw_hits* hits,
                         std::uint64_t capacity, std::uint64_t* needed, const rw_query_options* options);

void candidate_count(std::uint32_t* count);
void get_candidate(const Plan& plan, const Tracer& tracer, std::uint32_t index, rw_candidate* candidate);
std::int32_t explain(const Plan& plan, const Tracer& tracer, const Profile& profile, std::int32_t format, char* buffer,
                     std::uint64_t capacity, std::uint64_t* needed);

} // namespace raywise::capi
