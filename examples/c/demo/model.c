#include "model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A mesh file may arrive as float32 or float64, indexed or not, with any stride: rw_array says which. memcpy because no
 * alignment is promised. */
static const char *element(const rw_array *array, uint64_t index, int64_t size, int64_t components) {
    if (array->stride == RW_REPEAT) return (const char *)array->data;
    const int64_t step = array->component_stride != 0 ? array->component_stride : size;
    const int64_t stride = array->stride != 0 ? array->stride : step * components;
    return (const char *)array->data + (int64_t)index * stride;
}

struct vector model_vertex(const struct model *model, uint64_t vertex) {
    const rw_array *array = &model->triangles.vertices;
    const int64_t size = array->type == RW_FLOAT64 ? 8 : 4;
    const int64_t step = array->component_stride != 0 ? array->component_stride : size;
    const char *at = element(array, vertex, size, 3);
    double value[3];
    for (int c = 0; c < 3; ++c, at += step) {
        if (array->type == RW_FLOAT64) {
            memcpy(&value[c], at, sizeof(double));
        } else {
            float narrow;
            memcpy(&narrow, at, sizeof narrow);
            value[c] = narrow;
        }
    }
    return (struct vector){value[0], value[1], value[2]};
}

void model_corners(const struct model *model, uint64_t triangle, uint64_t corner[3]) {
    const rw_array *array = &model->triangles.indices;
    if (array->data == NULL) {
        for (uint64_t c = 0; c < 3; ++c) corner[c] = 3 * triangle + c;
        return;
    }
    const int64_t size = array->type == RW_UINT64 ? 8 : 4;
    const int64_t step = array->component_stride != 0 ? array->component_stride : size;
    const char *at = element(array, triangle, size, 3);
    for (int c = 0; c < 3; ++c, at += step) {
        if (array->type == RW_UINT64) {
            memcpy(&corner[c], at, sizeof(uint64_t));
        } else {
            uint32_t narrow;
            memcpy(&narrow, at, sizeof narrow);
            corner[c] = narrow;
        }
    }
}

bool model_smooth(struct model *model) {
    const uint64_t vertices = model->triangles.vertex_count;
    model->vertex_normals = calloc(vertices != 0 ? vertices : 1, 3 * sizeof(float));
    if (model->vertex_normals == NULL) {
        fprintf(stderr, "raywise-demo: out of memory for the normals\n");
        return false;
    }
    for (uint64_t i = 0; i < model->triangles.triangle_count; ++i) {
        uint64_t corner[3];
        model_corners(model, i, corner);
        const struct vector a = model_vertex(model, corner[0]);
        const struct vector b = model_vertex(model, corner[1]);
        const struct vector c = model_vertex(model, corner[2]);
        /* The cross product's length is twice the area: large triangles count for more. */
        const struct vector n = vector_cross(vector_subtract(b, a), vector_subtract(c, a));
        for (int k = 0; k < 3; ++k) {
            float *sum = model->vertex_normals + 3 * corner[k];
            sum[0] += (float)n.x;
            sum[1] += (float)n.y;
            sum[2] += (float)n.z;
        }
    }
    return true;
}

bool model_reserve(struct model *model, uint64_t vertices, uint64_t triangles) {
    model->own_vertices = malloc(vertices * 3 * sizeof(float));
    model->own_indices = malloc(triangles * 3 * sizeof(uint32_t));
    model->own_paint = malloc(triangles);
    if (model->own_vertices == NULL || model->own_indices == NULL || model->own_paint == NULL) {
        fprintf(stderr, "raywise-demo: out of memory for %llu triangles\n", (unsigned long long)triangles);
        return false;
    }
    return true;
}

void model_finish(struct model *model) {
    rw_triangles *triangles = &model->triangles;
    triangles->struct_size = sizeof *triangles;
    triangles->flags = RW_TRIANGLES_SHARED;
    triangles->vertex_count = model->vertex_count;
    triangles->vertices.data = model->own_vertices;
    triangles->triangle_count = model->triangle_count;
    triangles->indices.data = model->own_indices;
    model->paint = model->own_paint;
}

bool model_load(struct model *model, const struct api *api, const char *path) {
    if (!api_ok(api, api->mesh_load(path, &model->file), "rw_mesh_load")) return false;
    model->triangles.struct_size = sizeof model->triangles;
    if (!api_ok(api, api->mesh_triangles(model->file, &model->triangles), "rw_mesh_triangles")) return false;
    model->triangles.flags |= RW_TRIANGLES_SHARED;
    model->vertex_count = model->triangles.vertex_count;
    model->triangle_count = model->triangles.triangle_count;

    const char *slash = strrchr(path, '/');
    snprintf(model->title, sizeof model->title, "%s", slash != NULL ? slash + 1 : path);
    /* Files do not say which way is up. Most models that people exchange stand on the xz plane. */
    model->up = MODEL_UP_Y;
    model->wants_ground = true;
    model->ground = -INFINITY;
    model->ground_colour = (struct vector){0.64, 0.63, 0.61};
    model->palette[0] = (struct vector){0.62, 0.46, 0.33};
    return true;
}

void model_free(struct model *model, const struct api *api) {
    if (model->file != NULL) api->mesh_release(model->file);
    free(model->own_vertices);
    free(model->own_indices);
    free(model->own_paint);
    free(model->vertex_normals);
    memset(model, 0, sizeof *model);
}
