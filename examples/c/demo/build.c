#include "build.h"

#include "progress.h"

#include <stdio.h>
#include <string.h>

/* Builds that take longer are called off: a demonstration should end. */
#define BUILD_CAP_NS 60e9

struct build_watch {
    struct progress progress;
    bool limited;
    bool cut;
};

static int32_t watch_build(void *user, double fraction, const char *stage) {
    (void)stage;
    struct build_watch *watch = user;
    progress_update(&watch->progress, fraction);
    watch->cut = watch->limited && clock_ns() - watch->progress.started > BUILD_CAP_NS;
    return watch->cut;
}

static rw_commit_options commit_options(const struct bench *bench, struct build_watch *watch) {
    rw_commit_options options;
    memset(&options, 0, sizeof options);
    options.struct_size = sizeof options;
    options.threads = bench->threads;
    options.progress = watch_build;
    options.progress_user = watch;
    return options;
}

/* Fills a scene and commits it. With `limited`, a build that takes too long is called off: *cut is then true and
 * there is no scene, which is not a failure. */
static bool make(const struct bench *bench, const char *structure, int32_t kind, uint64_t rays, const char *title,
                 bool limited, rw_scene **result, double *commit_ns, bool *cut) {
    const struct api *api = bench->api;
    rw_scene *scene = NULL;
    *result = NULL;
    *cut = false;
    if (!api_ok(api, api->scene_create(bench->profile, &scene), "rw_scene_create")) return false;

    bool good = true;
    for (uint32_t i = 0; good && i < bench->mesh_count; ++i)
        good = api_ok(api, api->scene_add_triangles(scene, &bench->meshes[i], NULL), "rw_scene_add_triangles");
    rw_expected_rays expected;
    memset(&expected, 0, sizeof expected);
    expected.struct_size = sizeof expected;
    expected.kind = kind;
    expected.count = rays;
    good = good && api_ok(api, api->scene_set_expected_rays(scene, &expected), "rw_scene_set_expected_rays");
    if (structure != NULL)
        good = good && api_ok(api, api->scene_set_structure(scene, structure), "rw_scene_set_structure");
    if (good) {
        struct build_watch watch;
        memset(&watch, 0, sizeof watch);
        watch.limited = limited;
        progress_begin(&watch.progress, title);
        const rw_commit_options options = commit_options(bench, &watch);
        const double start = clock_ns();
        const int32_t status = api->scene_commit(scene, &options);
        *commit_ns = clock_ns() - start;
        progress_end(&watch.progress);
        *cut = status == RW_ERROR_CANCELLED && watch.cut;
        good = *cut || api_ok(api, status, "rw_scene_commit");
    }
    if (good && !*cut)
        *result = scene;
    else
        api->scene_release(scene);
    return good;
}

bool scene_make(const struct bench *bench, const char *structure, int32_t kind, uint64_t rays, const char *title,
                rw_scene **scene) {
    double commit_ns = 0.0;
    bool cut = false;
    return make(bench, structure, kind, rays, title, false, scene, &commit_ns, &cut);
}

void forced_free(struct forced_scenes *forced, const struct api *api) {
    for (uint32_t i = 0; i < MOST_STRUCTURES; ++i) api->scene_release(forced->scenes[i].scene);
    memset(forced, 0, sizeof *forced);
}

bool scene_force(const struct bench *bench, const rw_candidate *said, int32_t kind, uint64_t rays,
                 struct forced *forced) {
    const struct api *api = bench->api;
    /* The library may build with more care when more rays are coming. It then predicts another build time. */
    const double change = said->predicted_build_ns - forced->predicted_build_ns;
    const bool same = !(fabs(change) > 0.001 * fabs(forced->predicted_build_ns));
    if ((forced->scene != NULL || forced->cut) && same) return true;
    api->scene_release(forced->scene);
    memset(forced, 0, sizeof *forced);
    forced->predicted_build_ns = said->predicted_build_ns;

    char title[64];
    snprintf(title, sizeof title, "building %s", said->structure);
    /* Short builds are done three times: the first may wake threads and fetch fresh pages. The smallest of three,
     * since whatever disturbs a build makes it longer. */
    double spent = 0.0;
    for (int i = 0; i < 3 && (i == 0 || spent + spent / i < bench->cap_seconds * 1e9); ++i) {
        rw_scene *scene = NULL;
        double commit_ns = 0.0;
        bool cut = false;
        if (!make(bench, said->structure, kind, rays, title, true, &scene, &commit_ns, &cut)) return false;
        if (cut) {
            api->scene_release(forced->scene);
            forced->scene = NULL;
            forced->cut = true;
            forced->build_ns = commit_ns;
            return true;
        }
        rw_scene_statistics statistics;
        memset(&statistics, 0, sizeof statistics);
        statistics.struct_size = sizeof statistics;
        if (!api_ok(api, api->scene_get_statistics(scene, &statistics), "rw_scene_get_statistics")) {
            api->scene_release(scene);
            return false;
        }
        /* By our own stopwatch, but without the time for choosing, which a candidate is not to blame for. */
        double build_ns = commit_ns - statistics.decide_ns;
        if (!(build_ns > 0.0)) build_ns = 0.0;
        if (i == 0 || build_ns < forced->build_ns) forced->build_ns = build_ns;
        forced->bytes = statistics.structure_bytes;
        api->scene_release(forced->scene);
        forced->scene = scene;
        spent += commit_ns;
    }
    return true;
}

bool view_make(const struct bench *bench, const rw_scene *scene, const rw_view_options *options, const char *structure,
               rw_scene **view, double *create_ns, bool *unfit, bool *cut) {
    const struct api *api = bench->api;
    rw_view_options wanted = *options;
    wanted.structure = structure;
    char title[64];
    snprintf(title, sizeof title, "building %s for the view", structure != NULL ? structure : "the chosen structure");
    struct build_watch watch;
    memset(&watch, 0, sizeof watch);
    watch.limited = structure != NULL;
    progress_begin(&watch.progress, title);
    const rw_commit_options commit = commit_options(bench, &watch);
    const double start = clock_ns();
    const int32_t status = api->scene_view(scene, &wanted, &commit, view);
    *create_ns = clock_ns() - start;
    progress_end(&watch.progress);
    *unfit = structure != NULL && status == RW_ERROR_WRONG_STRUCTURE;
    *cut = status == RW_ERROR_CANCELLED && watch.cut;
    return *unfit || *cut || api_ok(api, status, "rw_scene_view");
}
