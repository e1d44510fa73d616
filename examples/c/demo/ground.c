#include "ground.h"

#include <string.h>

void ground_place(struct ground *ground, const struct stage *stage) {
    memset(ground, 0, sizeof *ground);
    const double half = 3.0 * stage->radius;
    ground->fades_from = 1.3 * stage->radius;
    ground->fades_to = 2.9 * stage->radius;
    const double drop = vector_dot(stage->center, stage->up) - stage->ground;
    ground->middle = vector_subtract(stage->center, vector_scale(stage->up, drop));

    static const double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    static const uint32_t indices[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (int i = 0; i < 4; ++i) {
        struct vector p = vector_add(ground->middle, vector_scale(stage->front, half * corners[i][0]));
        p = vector_add(p, vector_scale(stage->side, half * corners[i][1]));
        ground->vertices[i][0] = (float)p.x;
        ground->vertices[i][1] = (float)p.y;
        ground->vertices[i][2] = (float)p.z;
    }
    memcpy(ground->indices, indices, sizeof indices);

    ground->triangles.struct_size = sizeof ground->triangles;
    ground->triangles.flags = RW_TRIANGLES_SHARED;
    ground->triangles.vertex_count = 4;
    ground->triangles.vertices.data = ground->vertices;
    ground->triangles.triangle_count = 2;
    ground->triangles.indices.data = ground->indices;
}
