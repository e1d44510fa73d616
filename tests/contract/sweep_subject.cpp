#include "contract/sweep_subject.h"

#include "contract/sweep_layout.h"

#include <algorithm>
#include <utility>

namespace raywise::sweep {
namespace {

constexpr const char* reference_structure = "bvh";
// Any number that makes building pay: which one changes no answer.
constexpr std::uint64_t expected_rays = 1000000;

void put(double (&to)[3], const Vec3& from) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

SceneHandle view_of(const rw_scene* scene, rw_view_options options, const char* structure) {
    options.count = expected_rays;
    options.structure = structure;
    rw_scene* view = nullptr;
    must(rw_scene_view(scene, &options, nullptr, &view), "rw_scene_view");
    return SceneHandle(view);
}

struct NamedView {
    const char* name;
    rw_view_options options;
};

std::vector<NamedView> views_of(const SweepScene& scene) {
    NamedView eye{"view from the eye", sized<rw_view_options>()};
    eye.options.kind = RW_VIEW_POINT;
    put(eye.options.origin, scene.eye);
    eye.options.ray_kind = RW_RAYS_CAMERA;

    NamedView light{"view from the light", sized<rw_view_options>()};
    light.options.kind = RW_VIEW_POINT;
    put(light.options.origin, scene.light);
    put(light.options.direction, scene.center - scene.light);
    light.options.half_angle = 0.6;
    light.options.ray_kind = RW_RAYS_SHADOW;

    NamedView sun{"view along the sun", sized<rw_view_options>()};
    sun.options.kind = RW_VIEW_DIRECTION;
    put(sun.options.direction, scene.sun);
    sun.options.ray_kind = RW_RAYS_SHADOW;
    return {eye, light, sun};
}

} // namespace

SceneHandle committed_scene(const rw_triangles& triangles, const char* structure) {
    rw_scene* made = nullptr;
    must(rw_scene_create(nullptr, &made), "rw_scene_create");
    SceneHandle scene(made);
    must(rw_scene_add_triangles(made, &triangles, nullptr), "rw_scene_add_triangles");
    must(rw_scene_set_structure(made, structure), "rw_scene_set_structure");
    rw_expected_rays expected = sized<rw_expected_rays>();
    expected.count = expected_rays;
    must(rw_scene_set_expected_rays(made, &expected), "rw_scene_set_expected_rays");
    must(rw_scene_commit(made, nullptr), "rw_scene_commit");
    return scene;
}

SceneHandle point_view(const rw_scene* scene, const Vec3& point, const char* structure) {
    rw_view_options options = sized<rw_view_options>();
    options.kind = RW_VIEW_POINT;
    put(options.origin, point);
    return view_of(scene, options, structure);
}

std::vector<std::string> structure_names() {
    std::uint32_t count = 0;
    must(rw_structure_count(&count), "rw_structure_count");
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < count; ++i) {
        const char* name = nullptr;
        must(rw_structure_name(i, &name), "rw_structure_name");
        names.emplace_back(name);
    }
    return names;
}

// To a scene, which has no view, they are candidates that do not apply.
std::vector<std::string> projecting_structures(const rw_scene* scene) {
    std::uint32_t count = 0;
    must(rw_scene_candidate_count(scene, &count), "rw_scene_candidate_count");
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < count; ++i) {
        rw_candidate candidate = sized<rw_candidate>();
        must(rw_scene_get_candidate(scene, i, &candidate), "rw_scene_get_candidate");
        if ((candidate.flags & RW_CANDIDATE_NOT_APPLICABLE) != 0) names.emplace_back(candidate.structure);
    }
    return names;
}

Subject reference_of(const SweepScene& scene) {
    const LaidOutMesh mesh(scene.mesh, MeshLayout{});
    return {"reference " + std::string(reference_structure), committed_scene(mesh.triangles(), reference_structure)};
}

std::vector<Subject> subjects_of(const SweepScene& scene, const Subject& reference, std::size_t index) {
    std::vector<Subject> subjects;
    const std::vector<std::string> names = structure_names();
    std::size_t turn = index;
    const auto next_layout = [&turn, &scene] {
        ++turn;
        return MeshLayout{scene.float32 && turn % 2 == 0, turn % 3 == 0, turn % 5 < 2, turn % 7 == 0};
    };
    for (const std::string& name : names) {
        const LaidOutMesh mesh(scene.mesh, next_layout());
        subjects.emplace_back(name, committed_scene(mesh.triangles(), name.c_str()));
    }
    const LaidOutMesh mesh(scene.mesh, next_layout());
    subjects.emplace_back("library's choice", committed_scene(mesh.triangles(), nullptr));

    const std::vector<std::string> projecting = projecting_structures(reference.scene());
    const std::vector<NamedView> views = views_of(scene);
    const auto add_view = [&](const NamedView& view, const std::string& structure) {
        subjects.emplace_back(std::string(view.name) + ", " + structure,
                              view_of(reference.scene(), view.options, structure.c_str()));
    };
    for (const NamedView& view : views) {
        for (const std::string& structure : projecting) add_view(view, structure);
    }
    std::vector<std::string> others;
    for (const std::string& name : names) {
        const bool projects = std::find(projecting.begin(), projecting.end(), name) != projecting.end();
        if (!projects && name != "linear_scan") others.push_back(name);
    }
    add_view(views[index % views.size()], others[index % others.size()]);
    return subjects;
}

} // namespace raywise::sweep
