/* Scenes and views, with what it took to build them. */
#ifndef DEMO_BUILD_H
#define DEMO_BUILD_H

#include "ask.h"

enum {
    MOST_STRUCTURES = 24
};

/* What all measurements share. */
struct bench {
    const struct api *api;
    const rw_profile *profile;
    const rw_triangles *meshes;
    uint32_t mesh_count;
    uint32_t threads;
    double cap_seconds;
};

/* A scene for each structure, forced, built once and asked for several numbers of rays. */
struct forced {
    const rw_scene *scene; /* NULL: not built */
    bool cut;
    double build_ns;
    double predicted_build_ns;
    uint64_t bytes;
};

struct forced_scenes {
    struct forced scenes[MOST_STRUCTURES];
};

void forced_free(struct forced_scenes *forced, const struct api *api);

/* A committed scene of the bench's meshes, with the library's choice (structure NULL) or a forced one. */
bool scene_make(const struct bench *bench, const char *structure, int32_t kind, uint64_t rays, const char *title,
                rw_scene **scene);

/* Builds a structure for its measurement, unless that has been done for an earlier number of rays. */
bool scene_force(const struct bench *bench, const rw_candidate *said, int32_t kind, uint64_t rays,
                 struct forced *forced);

/* A view, with how long it took to make. With a forced structure, one that cannot serve this view is not a failure:
 * *unfit is then true and there is no view; and a build that takes too long is called off: *cut is then true. */
bool view_make(const struct bench *bench, const rw_scene *scene, const rw_view_options *options, const char *structure,
               rw_scene **view, double *create_ns, bool *unfit, bool *cut);

#endif
