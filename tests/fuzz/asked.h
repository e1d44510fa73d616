// Whom a question goes to: a scene or a view, which have the same functions under two names.
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
    Asked(const rw_view* view, std::string name) : view_(view), name_(std::move(name)) {}

    const std::string& name() const { return name_; }
    Usage* usage() const { return usage_; } // null: nobody counts

    // options NULL: by the functions that take none.
    std::int32_t intersect(const rw_ray* ray, const rw_ray_options* options, rw_hit* hit) const {
        if (options == nullptr)
            return view_ != nullptr ? rw_view_intersect(view_, ray, hit) : rw_scene_intersect(scene_, ray, hit);
        return view_ != nullptr ? rw_view_intersect_with(view_, ray, options, hit)
                                : rw_scene_intersect_with(scene_, ray, options, hit);
    }
    std::int32_t occluded(const rw_ray* ray, const rw_ray_options* options, std::int32_t* answer) const {
        if (options == nullptr)
            return view_ != nullptr ? rw_view_occluded(view_, ray, answer) : rw_scene_occluded(scene_, ray, answer);
        return view_ != nullptr ? rw_view_occluded_with(view_, ray, options, answer)
                                : rw_scene_occluded_with(scene_, ray, options, answer);
    }
    std::int32_t intersect_all(const rw_ray* ray, const rw_ray_options* options, rw_hit* hits, std::uint64_t capacity,
                               std::uint64_t* needed) const {
        if (options == nullptr)
            return view_ != nullptr ? rw_view_intersect_all(view_, ray, hits, capacity, needed)
                                    : rw_scene_intersect_all(scene_, ray, hits, capacity, needed);
        return view_ != nullptr ? rw_view_intersect_all_with(view_, ray, options, hits, capacity, needed)
                                : rw_scene_intersect_all_with(scene_, ray, options, hits, capacity, needed);
    }
    std::int32_t intersect_batch(const rw_rays* rays, const rw_hits* hits, const rw_query_options* options) const {
        return view_ != nullptr ? rw_view_intersect_batch(view_, rays, hits, options)
                                : rw_scene_intersect_batch(scene_, rays, hits, options);
    }
    std::int32_t occluded_batch(const rw_rays* rays, const rw_output* answers, const rw_query_options* options) const {
        return view_ != nullptr ? rw_view_occluded_batch(view_, rays, answers, options)
                                : rw_scene_occluded_batch(scene_, rays, answers, options);
    }
    std::int32_t intersect_all_batch(const rw_rays* rays, std::uint64_t* offsets, const rw_hits* hits,
                                     std::uint64_t capacity, std::uint64_t* needed,
                                     const rw_query_options* options) const {
        return view_ != nullptr ? rw_view_intersect_all_batch(view_, rays, offsets, hits, capacity, needed, options)
                                : rw_scene_intersect_all_batch(scene_, rays, offsets, hits, capacity, needed, options);
    }
    std::int32_t candidate_count(std::uint32_t* count) const {
        return view_ != nullptr ? rw_view_candidate_count(view_, count) : rw_scene_candidate_count(scene_, count);
    }
    std::int32_t candidate(std::uint32_t index, rw_candidate* candidate) const {
        return view_ != nullptr ? rw_view_get_candidate(view_, index, candidate)
                                : rw_scene_get_candidate(scene_, index, candidate);
    }
    std::int32_t explain(std::int32_t format, char* buffer, std::uint64_t capacity, std::uint64_t* needed) const {
        return view_ != nullptr ? rw_view_explain(view_, format, buffer, capacity, needed)
                                : rw_scene_explain(scene_, format, buffer, capacity, needed);
    }

private:
    const rw_scene* scene_ = nullptr;
    const rw_view* view_ = nullptr;
    std::string name_;
    Usage* usage_ = nullptr;
};

} // namespace raywise::fuzz
