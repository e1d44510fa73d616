#include "commands.h"
#include "measure/library.h"
#include "progress_bar.h"

#include <cstdio>

namespace raywise::calibration {
namespace {

std::int32_t show_progress(void* bar, double fraction, const char* stage) {
    static_cast<ProgressBar*>(bar)->show(fraction, stage);
    return 0;
}

} // namespace

int run_explain(const ExplainOptions& options) {
    ProgressBar bar(false);
    rw_mesh* loaded = nullptr;
    check(rw_mesh_load(options.mesh.c_str(), &loaded), "rw_mesh_load");
    const Handle<rw_mesh> mesh(loaded);
    rw_triangles triangles{};
    triangles.struct_size = sizeof(triangles);
    check(rw_mesh_triangles(mesh.get(), &triangles), "rw_mesh_triangles");
    triangles.flags |= RW_TRIANGLES_SHARED;

    rw_scene* created = nullptr;
    check(rw_scene_create(nullptr, &created), "rw_scene_create");
    const Handle<rw_scene> scene(created);
    check(rw_scene_add_triangles(scene.get(), &triangles, nullptr), "rw_scene_add_triangles");
    rw_expected_rays expected{};
    expected.struct_size = sizeof(expected);
    expected.kind = options.kind;
    expected.count = options.rays;
    check(rw_scene_set_expected_rays(scene.get(), &expected), "rw_scene_set_expected_rays");
    rw_commit_options commit{};
    commit.struct_size = sizeof(commit);
    commit.progress = show_progress;
    commit.progress_user = &bar;
    check(rw_scene_commit(scene.get(), &commit), "rw_scene_commit");
    bar.finish();

    const std::int32_t format = options.json ? RW_FORMAT_JSON : RW_FORMAT_TEXT;
    std::uint64_t needed = 0;
    check(rw_scene_explain(scene.get(), format, nullptr, 0, &needed), "rw_scene_explain");
    std::string text(needed, '\0');
    check(rw_scene_explain(scene.get(), format, text.data(), needed, &needed), "rw_scene_explain");
    std::printf("%s%s", text.c_str(), needed >= 2 && text[needed - 2] == '\n' ? "" : "\n");
    return exit_ok;
}

} // namespace raywise::calibration
