// The library through dlopen, so that several builds of it can be in one process and take turns.
#pragma once

#include "scenes/scenes.h"

#include "raywise/raywise.h"

#include <memory>
#include <string>

namespace raywise::bench {

// What the benchmarks call.
#define RW_BENCH_FUNCTIONS(X)     \
    X(rw_last_error_message)      \
    X(rw_structure_count)         \
    X(rw_structure_name)          \
    X(rw_mesh_load)               \
    X(rw_mesh_triangles)          \
    X(rw_mesh_release)            \
    X(rw_scene_create)            \
    X(rw_scene_add_triangles)     \
    X(rw_scene_set_expected_rays) \
    X(rw_scene_set_structure)     \
    X(rw_scene_commit)            \
    X(rw_scene_refit)             \
    X(rw_scene_release)           \
    X(rw_scene_get_statistics)    \
    X(rw_scene_intersect)         \
    X(rw_scene_intersect_f32)     \
    X(rw_scene_occluded)          \
    X(rw_scene_occluded_f32)      \
    X(rw_scene_normal)            \
    X(rw_scene_intersect_batch)   \
    X(rw_scene_occluded_batch)

class Library {
public:
    // Throws std::runtime_error when the file is no such library.
    Library(std::string name, const std::string& path);
    Library(const Library&) = delete; // stays in memory for the life of the process
    Library& operator=(const Library&) = delete;

    const std::string& name() const { return name_; }
    // Throws std::runtime_error with the library's message when the status is not RW_OK.
    void check(std::int32_t status) const;

#define RW_BENCH_MEMBER(function) decltype(&::function) function = nullptr;
    RW_BENCH_FUNCTIONS(RW_BENCH_MEMBER)
#undef RW_BENCH_MEMBER

private:
    std::string name_;
};

} // namespace raywise::bench
