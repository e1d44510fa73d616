// Scenes: making, filling, committing.
#include "convert.h"
#include "guard.h"

#include <cmath>

using namespace raywise;
using namespace raywise::capi;

extern "C" {

std::int32_t rw_scene_create(const rw_profile* profile, rw_scene** scene) {
    return guard([&] {
        rw_scene*& out = required(scene, "scene");
        auto constants = profile != nullptr ? profile->value : kept_profile();
        out = new rw_scene(std::make_shared<Scene>(std::move(constants)));
    });
}

std::int32_t rw_scene_retain(const rw_scene* scene) {
    return guard([&] { retain(scene, "scene"); });
}

std::int32_t rw_scene_release(const rw_scene* scene) {
    return guard([&] { release(scene); });
}

std::int32_t rw_scene_add_triangles(rw_scene* scene, const rw_triangles* triangles, std::uint32_t* geometry) {
    return guard([&] {
        Scene& s = *required(scene, "scene").value;
        const rw_triangles mesh = read_struct(triangles, "triangles");
        const bool copy = (mesh.flags & RW_TRIANGLES_SHARED) == 0;
        const bool skip_invalid = (mesh.flags & RW_TRIANGLES_SKIP_INVALID) != 0;
        const std::uint32_t id = s.add_triangles(read_triangles(mesh), copy, skip_invalid);
        if (geometry != nullptr) *geometry = id;
    });
}

std::int32_t rw_scene_set_expected_rays(rw_scene* scene, const rw_expected_rays* expected) {
    return guard([&] {
        Scene& s = *required(scene, "scene").value;
        const rw_expected_rays e = read_struct(expected, "expected");
        const Workload workload = read_workload(e.count, e.kind, "expected");
        std::vector<Ray> sample;
        if (e.sample != nullptr) {
            const RayArrays rays = read_rays(e.sample, "expected.sample");
            const std::uint64_t count = std::min<std::uint64_t>(rays.count, 1000);
            sample.resize(count);
            rays.read({0, count}, sample.data());
        }
        s.set_expected(workload, std::move(sample));
    });
}

std::int32_t rw_scene_set_memory_limit(rw_scene* scene, std::uint64_t bytes) {
    return guard([&] { required(scene, "scene").value->set_memory_limit(bytes); });
}

std::int32_t rw_scene_set_structure(rw_scene* scene, const char* name) {
    return guard([&] { required(scene, "scene").value->set_structure(read_structure(name)); });
}

std::int32_t rw_scene_set_effort(rw_scene* scene, std::int32_t effort, std::int32_t rule, double time_limit_seconds) {
    return guard([&] {
        Scene& s = *required(scene, "scene").value;
        if (effort < RW_EFFORT_ESTIMATE || effort > RW_EFFORT_MEASURE) {
            throw Error(Status::ERROR_INVALID_ARGUMENT, "effort: " + std::to_string(effort) + " is no effort");
        }
        if (rule != RW_RULE_SMALLEST_TOTAL && rule != RW_RULE_HAPALA) {
            throw Error(Status::ERROR_INVALID_ARGUMENT, "rule: " + std::to_string(rule) + " is no rule");
        }
        if (!(time_limit_seconds >= 0.0)) {
            throw Error(Status::ERROR_INVALID_ARGUMENT, "time_limit_seconds: it is negative or NaN");
        }
        s.set_effort(static_cast<Effort>(effort), static_cast<Rule>(rule), time_limit_seconds);
    });
}

std::int32_t rw_scene_commit(rw_scene* scene, const rw_commit_options* options) {
    return guard([&] {
        Scene& s = *required(scene, "scene").value;
        const rw_commit_options o = read_commit_options(options, "options");
        Progress progress(read_progress(o.progress, o.progress_user));
        s.commit(read_parallel(o.threads, o.parallel_for, o.parallel_user), progress);
    });
}

std::int32_t rw_scene_refit(const rw_scene* scene, const rw_triangles* meshes, std::uint32_t mesh_count,
                            const rw_commit_options* options, rw_scene** refitted) {
    return guard([&] {
        const Scene& s = *required(scene, "scene").value;
        rw_scene*& out = required(refitted, "refitted");
        const rw_commit_options o = read_commit_options(options, "options");
        std::vector<MovedMesh> moved;
        for_each_mesh(meshes, mesh_count, [&](const rw_triangles& mesh, const std::string& name) {
            moved.push_back({read_triangles(mesh, name), (mesh.flags & RW_TRIANGLES_SHARED) == 0,
                             (mesh.flags & RW_TRIANGLES_SKIP_INVALID) != 0, name + "."});
        });
        Progress progress(read_progress(o.progress, o.progress_user));
        out = new rw_scene(s.refitted(moved, static_cast<RefitPolicy>(o.refit),
                                      read_parallel(o.threads, o.parallel_for, o.parallel_user), progress));
    });
}

} // extern "C"
