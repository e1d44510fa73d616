// Questions to a committed scene.
#include "query.h"

using namespace raywise;
using namespace raywise::capi;

extern "C" {

std::int32_t rw_scene_intersect(const rw_scene* scene, const rw_ray* ray, rw_hit* hit) {
    return guard([&] { intersect(required(scene, "scene").value->tracer(), ray, hit); });
}

std::int32_t rw_scene_occluded(const rw_scene* scene, const rw_ray* ray, std::int32_t* answer) {
    return guard([&] { occluded(required(scene, "scene").value->tracer(), ray, answer); });
}

std::int32_t rw_scene_intersect_all(const rw_scene* scene, const rw_ray* ray, rw_hit* hits, std::uint64_t capacity,
                                    std::uint64_t* needed) {
    return guard(
        [&] { intersect_all_with(required(scene, "scene").value->tracer(), ray, nullptr, hits, capacity, needed); });
}

std::int32_t rw_scene_intersect_with(const rw_scene* scene, const rw_ray* ray, const rw_ray_options* options,
                                     rw_hit* hit) {
    return guard([&] { intersect_with(required(scene, "scene").value->tracer(), ray, options, hit); });
}

std::int32_t rw_scene_occluded_with(const rw_scene* scene, const rw_ray* ray, const rw_ray_options* options,
                                    std::int32_t* answer) {
    return guard([&] { occluded_with(required(scene, "scene").value->tracer(), ray, options, answer); });
}

std::int32_t rw_scene_intersect_all_with(const rw_scene* scene, const rw_ray* ray, const rw_ray_options* options,
                                         rw_hit* hits, std::uint64_t capacity, std::uint64_t* needed) {
    return guard(
        [&] { intersect_all_with(required(scene, "scene").value->tracer(), ray, options, hits, capacity, needed); });
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

std::int32_t rw_scene_candidate_count(const rw_scene* scene, std::uint32_t* count) {
    return guard([&] {
        required(scene, "scene").value->plan();
        candidate_count(count);
    });
}

std::int32_t rw_scene_get_candidate(const rw_scene* scene, std::uint32_t index, rw_candidate* candidate) {
    return guard([&] {
        const Scene& value = *required(scene, "scene").value;
        get_candidate(value.plan(), value.tracer(), index, candidate);
    });
}

std::int32_t rw_scene_explain(const rw_scene* scene, std::int32_t format, char* buffer, std::uint64_t capacity,
                              std::uint64_t* needed) {
    return guard([&] {
        const Scene& value = *required(scene, "scene").value;
        return explain(value.plan(), value.tracer(), *value.profile(), format, buffer, capacity, needed);
    });
}

} // extern "C"
