// Questions to a committed scene.
#include "query.h"

using namespace raywise;
using namespace raywise::capi;

extern "C" {

std::int32_t rw_scene_intersect(const rw_scene* scene, const rw_ray* ray, const rw_ray_options* options, rw_hit* hit) {
    return guard([&] { intersect(required(scene, "scene").value->tracer(), ray, options, hit); });
}

std::int32_t rw_scene_occluded(const rw_scene* scene, const rw_ray* ray, const rw_ray_options* options,
                               std::int32_t* answer) {
    return guard([&] { occluded(required(scene, "scene").value->tracer(), ray, options, answer); });
}

std::int32_t rw_scene_intersect_all(const rw_scene* scene, const rw_ray* ray, const rw_ray_options* options,
                                    rw_hit* hits, std::uint64_t capacity, std::uint64_t* needed) {
    return guard(
        [&] { intersect_all(required(scene, "scene").value->tracer(), ray, options, hits, capacity, needed); });
}

std::int32_t rw_scene_intersect_f32(const rw_scene* scene, const rw_ray_f32* ray, const rw_ray_options* options,
                                    rw_hit_f32* hit) {
    return guard([&] { intersect(required(scene, "scene").value->tracer(), ray, options, hit); });
}

std::int32_t rw_scene_occluded_f32(const rw_scene* scene, const rw_ray_f32* ray, const rw_ray_options* options,
                                   std::int32_t* answer) {
    return guard([&] { occluded(required(scene, "scene").value->tracer(), ray, options, answer); });
}

std::int32_t rw_scene_intersect_all_f32(const rw_scene* scene, const rw_ray_f32* ray, const rw_ray_options* options,
                                        rw_hit_f32* hits, std::uint64_t capacity, std::uint64_t* needed) {
    return guard(
        [&] { intersect_all(required(scene, "scene").value->tracer(), ray, options, hits, capacity, needed); });
}

std::int32_t rw_scene_normal(const rw_scene* scene, const rw_hit* hit, double* result) {
    return guard([&] { normal(required(scene, "scene").value->tracer(), hit, result); });
}

std::int32_t rw_scene_normal_f32(const rw_scene* scene, const rw_hit_f32* hit, float* result) {
    return guard([&] { normal(required(scene, "scene").value->tracer(), hit, result); });
}

std::int32_t rw_scene_intersect_batch(const rw_scene* scene, const rw_rays* rays, const rw_hits* hits,
                                      const rw_query_options* options) {
    return guard([&] { intersect_batch(required(scene, "scene").value->tracer(), rays, hits, options); });
}

std::int32_t rw_scene_occluded_batch(const rw_scene* scene, const rw_rays* rays, const rw_output* answers,
                                     const rw_query_options* options) {
    return guard([&] { occluded_batch(required(scene, "scene").value->tracer(), rays, answers, options); });
}

std::int32_t rw_scene_intersect_all_batch(const rw_scene* scene, const rw_rays* rays, std::uint64_t* offsets,
                                          const rw_hits* hits, std::uint64_t capacity, std::uint64_t* needed,
                                          const rw_query_options* options) {
    return guard([&] {
        intersect_all_batch(required(scene, "scene").value->tracer(), rays, offsets, hits, capacity, needed, options);
    });
}

} // extern "C"
