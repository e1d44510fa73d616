// Whom a question goes to: a scene or a view.
#pragma once

#include "raywise/raywise.h"

#include <cstdint>
#include <string>
#include <utility>

namespace raywise::fuzz {

// What a scene has been asked, to be compared with its statistics.
struct Usage {
    std::uint64_t batch_rays = 0;
    std::uint64_t nan_rays = 0;
    bool is_known = true; // false after a batch that failed half-way
};

class Asked {
public:
    Asked(const rw_scene* scene, std::string name, Usage* usage = nullptr)
        : scene_(scene), name_(std::move(name)), usage_(usage) {}

    const std::string& name() const { return name_; }
    Usage* usage() const { return usage_; } // null: nobody counts

    std::int32_t intersect(const rw_ray* ray, const rw_ray_options* options, rw_hit* hit) const {
        return rw_scene_intersect(scene_, ray, options, hit);
    }
    std::int32_t occluded(const rw_ray* ray, const rw_ray_options* options, std::int32_t* answer) const {
        return rw_scene_occluded(scene_, ray, options, answer);
    }
    std::int32_t intersect_all(const rw_ray* ray, const rw_ray_options* options, rw_hit* hits, std::uint64_t capacity,
                               std::uint64_t* needed) const {
        return rw_scene_intersect_all(scene_, ray, options, hits, capacity, needed);
    }
    std::int32_t intersect(const rw_ray_f32* ray, const rw_ray_options* options, rw_hit_f32* hit) const {
        return rw_scene_intersect_f32(scene_, ray, options, hit);
    }
    std::int32_t normal(const rw_hit* hit, double* normal) const { return rw_scene_normal(scene_, hit, normal); }
    std::int32_t intersect_batch(const rw_rays* rays, const rw_hits* hits, const rw_query_options* options) const {
        return rw_scene_intersect_batch(scene_, rays, hits, options);
    }
    std::int32_t occluded_batch(const rw_rays* rays, const rw_output* answers, const rw_query_options* options) const {
        return rw_scene_occluded_batch(scene_, rays, answers, options);
    }
    std::int32_t intersect_all_batch(const rw_rays* rays, std::uint64_t* offsets, const rw_hits* hits,
                                     std::uint64_t capacity, std::uint64_t* needed,
                                     const rw_query_options* options) const {
        return rw_scene_intersect_all_batch(scene_, rays, offsets, hits, capacity, needed, options);
    }
    std::int32_t candidate_count(std::uint32_t* count) const { return rw_scene_candidate_count(scene_, count); }
    std::int32_t candidate(std::uint32_t index, rw_candidate* candidate) const {
        return rw_scene_get_candidate(scene_, index, candidate);
    }
    std::int32_t explain(std::int32_t format, char* buffer, std::uint64_t capacity, std::uint64_t* needed) const {
        return rw_scene_explain(scene_, format, buffer, capacity, needed);
    }

private:
    const rw_scene* scene_ = nullptr;
    std::string name_;
    Usage* usage_ = nullptr;
};

} // namespace raywise::fuzz
