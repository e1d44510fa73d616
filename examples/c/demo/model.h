/* What is looked at: a triangle mesh, from a file or of the demo's own, with what the picture needs besides. */
#ifndef DEMO_MODEL_H
#define DEMO_MODEL_H

#include "api.h"
#include "vector.h"

enum model_up {
    MODEL_UP_Y,
    MODEL_UP_Z
};

struct model {
    char title[64];
    rw_triangles triangles; /* as scenes are given it: shared, so these arrays have to outlive every scene */
    enum model_up up;
    bool wants_ground;           /* the picture stands it on a ground square, */
    double ground;               /* at this height, or at the lowest point when that is higher */
    struct vector ground_colour; /* linear RGB */

    const uint8_t *paint;     /* per triangle, an index into palette; NULL: all are palette[0] */
    struct vector palette[8]; /* linear RGB */
    float *vertex_normals;    /* 3 per vertex, for smooth shading */

    rw_mesh *file;       /* owner of the arrays when they come from a file */
    float *own_vertices; /* owners of the arrays otherwise */
    uint32_t *own_indices;
    uint8_t *own_paint;
    uint64_t vertex_count; /* filled while building */
    uint64_t triangle_count;
};

/* Each fills a zeroed model; false with a message on failure. model_free is harmless either way. */
bool model_load(struct model *model, const struct api *api, const char *path);
bool model_sphereflake(struct model *model, uint32_t detail);
bool model_terrain(struct model *model, uint32_t detail);
void model_free(struct model *model, const struct api *api);

/* For the makers of own scenes: room for so many vertices and triangles, then the finished arrays as rw_triangles. */
bool model_reserve(struct model *model, uint64_t vertices, uint64_t triangles);
void model_finish(struct model *model);

/* Averages the triangles' normals at each vertex, weighted by area. */
bool model_smooth(struct model *model);

struct vector model_vertex(const struct model *model, uint64_t vertex);
void model_corners(const struct model *model, uint64_t triangle, uint64_t corner[3]);

#endif
