#include "base/format.h"
#include "commands.h"
#include "measure/library.h"
#include "progress_bar.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace raywise::calibration {
namespace {

constexpr const char* kind_names[] = {"any", "random", "camera", "shadow", "diffuse"};

// Of the table: 1, 10, 100 ...
constexpr std::uint64_t most_rays = 100'000'000;
constexpr int rows = 9;

// The bar over `of` builds, of which `done` are over.
struct Builds {
    ProgressBar bar{false};
    int done = 0;
    int of = 1;
};

std::int32_t show_progress(void* user, double fraction, const char* stage) {
    auto& builds = *static_cast<Builds*>(user);
    builds.bar.show((builds.done + fraction) / builds.of, stage);
    return 0;
}

rw_triangles triangles_of(const rw_mesh* mesh) {
    rw_triangles triangles{};
    triangles.struct_size = sizeof(triangles);
    check(rw_mesh_triangles(mesh, &triangles), "rw_mesh_triangles");
    triangles.flags |= RW_TRIANGLES_SHARED;
    return triangles;
}

// As the library builds it for so many rays.
Handle<rw_scene> scene_for(std::uint64_t rays, std::int32_t kind, const rw_triangles& triangles, Builds& builds) {
    rw_scene* created = nullptr;
    check(rw_scene_create(nullptr, &created), "rw_scene_create");
    Handle<rw_scene> scene(created);
    check(rw_scene_add_triangles(scene.get(), &triangles, nullptr), "rw_scene_add_triangles");
    rw_expected_rays expected{};
    expected.struct_size = sizeof(expected);
    expected.kind = kind;
    expected.count = rays;
    check(rw_scene_set_expected_rays(scene.get(), &expected), "rw_scene_set_expected_rays");
    rw_commit_options commit{};
    commit.struct_size = sizeof(commit);
    commit.progress = show_progress;
    commit.progress_user = &builds;
    check(rw_scene_commit(scene.get(), &commit), "rw_scene_commit");
    ++builds.done;
    return scene;
}

rw_candidate chosen_of(const rw_scene* scene) {
    std::uint32_t count = 0;
    check(rw_scene_candidate_count(scene, &count), "rw_scene_candidate_count");
    for (std::uint32_t i = 0; i < count; ++i) {
        rw_candidate candidate{};
        candidate.struct_size = sizeof(candidate);
        check(rw_scene_get_candidate(scene, i, &candidate), "rw_scene_get_candidate");
        if ((candidate.flags & RW_CANDIDATE_CHOSEN) != 0) return candidate;
    }
    throw LibraryError("rw_scene_get_candidate: none is the chosen one");
}

void explain_one(const ExplainOptions& options, const rw_triangles& triangles) {
    Builds builds;
    const Handle<rw_scene> scene = scene_for(options.rays, options.kind, triangles, builds);
    builds.bar.finish();
    const std::int32_t format = options.json ? RW_FORMAT_JSON : RW_FORMAT_TEXT;
    std::uint64_t needed = 0;
    check(rw_scene_explain(scene.get(), format, nullptr, 0, &needed), "rw_scene_explain");
    std::string text(needed, '\0');
    check(rw_scene_explain(scene.get(), format, text.data(), needed, &needed), "rw_scene_explain");
    std::printf("%s%s", text.c_str(), needed >= 2 && text[needed - 2] == '\n' ? "" : "\n");
}

void explain_many(const ExplainOptions& options, const rw_triangles& triangles) {
    Builds builds;
    builds.of = rows;
    std::string table =
        format("%11s  %-13s %9s %9s %9s %9s\n", "rays", "structure", "build", "per ray", "total", "bytes");
    nlohmann::ordered_json choices = nlohmann::ordered_json::array();
    for (std::uint64_t rays = 1; rays <= most_rays; rays *= 10) {
        const Handle<rw_scene> scene = scene_for(rays, options.kind, triangles, builds);
        const rw_candidate chosen = chosen_of(scene.get());
        table +=
            format("%11s  %-13s %9s %9s %9s %9s\n", grouped_text(rays).c_str(), chosen.structure,
                   duration_text(chosen.predicted_build_ns).c_str(), duration_text(chosen.predicted_ray_ns).c_str(),
                   duration_text(chosen.predicted_total_ns).c_str(),
                   size_text(static_cast<double>(chosen.actual_bytes)).c_str());
        choices.push_back({{"rays", rays},
                           {"structure", chosen.structure},
                           {"predicted_build_ns", chosen.predicted_build_ns},
                           {"predicted_ray_ns", chosen.predicted_ray_ns},
                           {"predicted_total_ns", chosen.predicted_total_ns},
                           {"actual_bytes", chosen.actual_bytes}});
    }
    builds.bar.finish();
    const char* kind = kind_names[options.kind];
    if (options.json) {
        const nlohmann::ordered_json document = {
            {"triangles", triangles.triangle_count}, {"ray_kind", kind}, {"choices", choices}};
        std::printf("%s\n", document.dump(2).c_str());
        return;
    }
    std::printf("%s triangles; what is chosen for so many rays (kind: %s), with predicted times:\n%s",
                grouped_text(triangles.triangle_count).c_str(), kind, table.c_str());
}

} // namespace

int run_explain(const ExplainOptions& options) {
    rw_mesh* loaded = nullptr;
    check(rw_mesh_load(options.mesh.c_str(), &loaded), "rw_mesh_load");
    const Handle<rw_mesh> mesh(loaded);
    const rw_triangles triangles = triangles_of(mesh.get());
    if (options.rays == 0) {
        explain_many(options, triangles);
    } else {
        explain_one(options, triangles);
    }
    return exit_ok;
}

} // namespace raywise::calibration
