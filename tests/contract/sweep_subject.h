// What is asked: a committed scene or a view, with its name.
#pragma once

#include "contract/sweep_handles.h"
#include "contract/sweep_scenes.h"

#include <string>
#include <vector>

namespace raywise::sweep {

class Subject {
public:
    Subject(std::string name, SceneHandle scene) : name_(std::move(name)), scene_(std::move(scene)) {}

    const std::string& name() const { return name_; }
    const rw_scene* scene() const { return scene_.get(); }
    // Looks at every triangle for every ray: on large scenes it can answer only a few.
    bool scans() const { return name_ == "linear_scan"; }

    std::int32_t closest(const rw_ray* ray, rw_hit* hit) const {
        return rw_scene_intersect(scene_.get(), ray, nullptr, hit);
    }
    std::int32_t any(const rw_ray* ray, std::int32_t* hit) const {
        return rw_scene_occluded(scene_.get(), ray, nullptr, hit);
    }
    std::int32_t all(const rw_ray* ray, rw_hit* hits, std::uint64_t capacity, std::uint64_t* needed) const {
        return rw_scene_intersect_all(scene_.get(), ray, nullptr, hits, capacity, needed);
    }
    std::int32_t closest_batch(const rw_rays* rays, const rw_hits* hits, const rw_query_options* options) const {
        return rw_scene_intersect_batch(scene_.get(), rays, hits, options);
    }
    std::int32_t any_batch(const rw_rays* rays, const rw_output* hit, const rw_query_options* options) const {
        return rw_scene_occluded_batch(scene_.get(), rays, hit, options);
    }
    std::int32_t all_batch(const rw_rays* rays, std::uint64_t* offsets, const rw_hits* hits, std::uint64_t capacity,
                           std::uint64_t* needed, const rw_query_options* options) const {
        return rw_scene_intersect_all_batch(scene_.get(), rays, offsets, hits, capacity, needed, options);
    }

private:
    std::string name_;
    SceneHandle scene_;
};

// A committed scene of a mesh. structure: forced by name; nullptr: the library chooses.
SceneHandle committed_scene(const rw_triangles& triangles, const char* structure);
// All around a point. structure: forced by name.
SceneHandle point_view(const rw_scene* scene, const Vec3& point, const char* structure);

// The names of all structures, and of those that project: made for views.
std::vector<std::string> structure_names();
std::vector<std::string> projecting_structures(const rw_scene* scene);

// The structure all others are compared with, on a mesh of float64 vertices in the plainest layout.
Subject reference_of(const SweepScene& scene);
// Every structure on a mesh in a layout of its own; the library's choice; views from the eye, the light and along the sun on
// each structure that projects, and one on another structure. index: of the scene, so that layouts take turns.
std::vector<Subject> subjects_of(const SweepScene& scene, const Subject& reference, std::size_t index);

} // namespace raywise::sweep
