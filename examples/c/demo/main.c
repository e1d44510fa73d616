/* raywise-demo: what raywise is for, in one program. See args.c for the command line, or run it with --help.
 *
 * The steps, in this order: a calibration profile, a mesh, decisions for several numbers of rays, decisions for a
 * camera and a lamp, a picture, and a check of the answers. */
#include "api.h"
#include "args.h"
#include "camera.h"
#include "check.h"
#include "decision.h"
#include "decision_table.h"
#include "ground.h"
#include "model.h"
#include "numbers.h"
#include "png_write.h"
#include "profile.h"
#include "rays.h"
#include "render.h"
#include "report.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    EXIT_WRONG_ANSWER = 1,
    EXIT_FAILED = 2
};

/* Random rays are taken from a list of at most so many; a larger --rays is extrapolated. */
#define RANDOM_RAYS 1000000u

/* Everything that has to be given back at the end, in one place, so that each step may simply stop. */
struct demo {
    struct args args;
    struct api api;
    rw_profile *profile;
    struct model model;
    struct ground ground;
    struct stage stage;
    struct camera camera;
    struct lamp lamp;
    struct ray_list random_rays;
    struct ray_list camera_rays;
    struct ray_list shadow_rays;
    struct forced_scenes forced;
    rw_scene *picture_scene;
    rw_scene *camera_view;
    rw_scene *lamp_view;
    rw_triangles meshes[2];
    struct decision decisions[MOST_DECISIONS];
    uint32_t decision_count;
    struct decision views[MOST_VIEWS];
    uint32_t view_count;
    struct picture picture;
    struct check check;
};

static struct bench bench_of(const struct demo *demo, uint32_t meshes) {
    return (struct bench){&demo->api, demo->profile, demo->meshes, meshes, demo->args.threads, demo->args.cap_seconds};
}

static bool explain(const struct demo *demo, const rw_scene *scene) {
    const struct api *api = &demo->api;
    uint64_t needed = 0;
    if (!api_ok(api, api->scene_explain(scene, RW_FORMAT_TEXT, NULL, 0, &needed), "rw_scene_explain")) return false;
    char *text = malloc(needed != 0 ? needed : 1);
    if (text == NULL) {
        fprintf(stderr, "raywise-demo: out of memory\n");
        return false;
    }
    const bool good = api_ok(api, api->scene_explain(scene, RW_FORMAT_TEXT, text, needed, NULL), "rw_scene_explain");
    if (good) printf("\n%s\n", text);
    free(text);
    return good;
}

static bool load_model(struct demo *demo) {
    const struct args *args = &demo->args;
    struct model *model = &demo->model;
    const bool made = args->mesh != NULL                    ? model_load(model, &demo->api, args->mesh)
                      : strcmp(args->scene, "terrain") == 0 ? model_terrain(model, args->detail)
                                                            : model_sphereflake(model, args->detail);
    if (!made || !model_smooth(model)) return false;
    demo->meshes[0] = model->triangles;
    struct number triangles, vertices;
    printf("scene    %s: %s triangle%s, %s vertices\n", model->title, number_count(&triangles, model->triangle_count),
           model->triangle_count == 1 ? "" : "s", number_count(&vertices, model->vertex_count));

    /* The library knows the box around the mesh as soon as a scene is committed; nothing is built for a plain scan. */
    const struct bench bench = bench_of(demo, 1);
    rw_scene *scene = NULL;
    double lower[3], upper[3];
    if (!scene_make(&bench, "linear_scan", RW_RAYS_ANY_KIND, 1, "measuring the mesh", &scene)) return false;
    const bool good = api_ok(&demo->api, demo->api.scene_bounds(scene, lower, upper), "rw_scene_bounds");
    demo->api.scene_release(scene);
    if (!good) return false;
    stage_set(&demo->stage, lower, upper, model);
    return true;
}

static int by_size(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static bool decide_scenes(struct demo *demo) {
    uint64_t counts[MOST_DECISIONS] = {1, 1000, 100000, 1000000};
    uint32_t count = 4;
    const uint64_t own = demo->args.rays;
    if (own != 0 && own != 1 && own != 1000 && own != 100000 && own != 1000000) counts[count++] = own;
    qsort(counts, count, sizeof counts[0], by_size);

    if (!rays_random(&demo->random_rays, demo->stage.center, demo->stage.radius, RANDOM_RAYS, 1)) return false;
    printf("rays     chords between random points of the sphere around the scene, closest hit\n");
    decision_legend();
    const struct bench bench = bench_of(demo, 1);
    for (uint32_t i = 0; i < count; ++i) {
        struct decision *decision = &demo->decisions[i];
        if (!decision_scene(&bench, &demo->forced, &demo->random_rays, counts[i], decision)) return false;
        ++demo->decision_count;
        decision_print(decision);
    }
    return check_structures(&demo->check, &demo->api, &demo->forced, &demo->decisions[0], &demo->random_rays,
                            demo->args.threads);
}

static bool decide_views(struct demo *demo) {
    const struct api *api = &demo->api;
    const uint32_t size = demo->args.size;
    uint32_t meshes = 1;
    double reach = demo->stage.radius;
    if (demo->model.wants_ground) {
        ground_place(&demo->ground, &demo->stage);
        demo->meshes[meshes++] = demo->ground.triangles;
        reach = hypot(demo->ground.fades_to, demo->stage.radius);
    }
    camera_frame(&demo->camera, &demo->model, &demo->stage, size);
    lamp_place(&demo->lamp, &demo->stage, reach);

    const struct bench bench = bench_of(demo, meshes);
    const uint64_t pixels = (uint64_t)size * size;
    if (!scene_make(&bench, NULL, RW_RAYS_CAMERA, pixels, "building the picture's scene", &demo->picture_scene))
        return false;
    if (demo->args.explain && !explain(demo, demo->picture_scene)) return false;

    char title[64];
    struct number number;
    const struct look look = {&demo->model, meshes == 2 ? &demo->ground : NULL, &demo->stage, &demo->camera,
                              &demo->lamp};
    if (!render_camera_rays(&look, &demo->camera_rays)) return false;
    rw_view_options options = camera_view(&demo->camera, pixels);
    snprintf(title, sizeof title, "%s camera rays", number_count(&number, pixels));
    if (!decision_view(&bench, demo->picture_scene, &options, &demo->camera_rays, title, &demo->views[0],
                       &demo->camera_view))
        return false;
    demo->view_count = 1;
    decision_print(&demo->views[0]);
    if (demo->args.explain && !explain(demo, demo->camera_view)) return false;

    const struct target camera = {api, demo->camera_view, false, demo->args.threads};
    if (!render_shadow_rays(&look, &camera, &demo->camera_rays, &demo->shadow_rays)) return false;
    if (demo->shadow_rays.count == 0) {
        printf("\nNothing that the camera sees faces the lamp: no shadow rays.\n");
        return true;
    }
    options = lamp_view(&demo->lamp, demo->shadow_rays.count);
    snprintf(title, sizeof title, "%s shadow rays", number_count(&number, demo->shadow_rays.count));
    if (!decision_view(&bench, demo->picture_scene, &options, &demo->shadow_rays, title, &demo->views[1],
                       &demo->lamp_view))
        return false;
    demo->view_count = 2;
    decision_print(&demo->views[1]);
    return !demo->args.explain || explain(demo, demo->lamp_view);
}

static bool make_picture(struct demo *demo) {
    const struct api *api = &demo->api;
    const uint32_t threads = demo->args.threads;
    const bool ground = demo->model.wants_ground;
    const struct look look = {&demo->model, ground ? &demo->ground : NULL, &demo->stage, &demo->camera, &demo->lamp};
    const struct target camera = {api, demo->camera_view, false, threads};
    const struct target lamp = {api, demo->lamp_view, true, threads};
    if (!render(&demo->picture, &look, &camera, &lamp, demo->args.samples, &demo->check) ||
        !png_write(&demo->picture, demo->args.output))
        return false;

    const struct bench bench = bench_of(demo, ground ? 2 : 1);
    rw_scene *scan = NULL;
    if (!scene_make(&bench, "linear_scan", RW_RAYS_CAMERA, CHECK_MOST, "building the plain scan", &scan)) return false;
    const bool checked = check_picture(&demo->check, api, scan, threads, demo->camera.eye, demo->lamp.point);
    api->scene_release(scan);
    return checked;
}

/* Whether a file can be written there, before a minute of work goes into its content. */
static bool writable(const char *path) {
    FILE *file = fopen(path, "ab");
    if (file == NULL) {
        fprintf(stderr, "raywise-demo: cannot write %s: %s\n", path, strerror(errno));
        return false;
    }
    const bool fresh = fseek(file, 0, SEEK_END) == 0 && ftell(file) == 0;
    fclose(file);
    if (fresh) remove(path);
    return true;
}

static int run(struct demo *demo, int argc, char **argv) {
    const enum args_result parsed = args_parse(&demo->args, argc, argv);
    if (parsed != ARGS_RUN) return parsed == ARGS_HELP ? EXIT_SUCCESS : EXIT_FAILED;
    if (!writable(demo->args.output) || (demo->args.json != NULL && !writable(demo->args.json))) return EXIT_FAILED;
    if (!api_open(&demo->api, demo->args.library)) return EXIT_FAILED;
    uint32_t version[3];
    if (!api_ok(&demo->api, demo->api.version(&version[0], &version[1], &version[2]), "rw_version")) return EXIT_FAILED;
    printf("raywise  %u.%u.%u\n", (unsigned)version[0], (unsigned)version[1], (unsigned)version[2]);

    if (!profile_get(&demo->api, &demo->args, &demo->profile) || !load_model(demo) || !decide_scenes(demo) ||
        !decide_views(demo) || !make_picture(demo))
        return EXIT_FAILED;

    const struct report report = {&demo->args,          &demo->api,  demo->profile,    &demo->model,   demo->decisions,
                                  demo->decision_count, demo->views, demo->view_count, &demo->picture, &demo->check};
    report_summary(&report);
    if (demo->args.json != NULL && !report_json(&report, argc, argv)) return EXIT_FAILED;
    return demo->check.different == 0 ? EXIT_SUCCESS : EXIT_WRONG_ANSWER;
}

static void clean_up(struct demo *demo) {
    picture_free(&demo->picture);
    ray_list_free(&demo->random_rays);
    ray_list_free(&demo->camera_rays);
    ray_list_free(&demo->shadow_rays);
    if (demo->api.library == NULL) return;
    /* Scenes before the meshes that they share. */
    demo->api.scene_release(demo->camera_view);
    demo->api.scene_release(demo->lamp_view);
    demo->api.scene_release(demo->picture_scene);
    forced_free(&demo->forced, &demo->api);
    model_free(&demo->model, &demo->api);
    demo->api.profile_release(demo->profile);
    api_close(&demo->api);
}

int main(int argc, char **argv) {
    /* Too large for a stack that somebody has made small. */
    struct demo *demo = calloc(1, sizeof *demo);
    if (demo == NULL) {
        fprintf(stderr, "raywise-demo: out of memory\n");
        return EXIT_FAILED;
    }
    const int code = run(demo, argc, argv);
    fflush(stdout);
    clean_up(demo);
    free(demo);
    return code;
}
