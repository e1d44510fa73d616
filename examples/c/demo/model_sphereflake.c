/* The "balls" scene of Eric Haines's Standard Procedural Databases (1987): a sphere with nine children of a third of
 * its radius, each of which has nine children. Six of the nine sit around the parent's equator and three above it;
 * every child takes the direction away from its parent for its own axis. Here the spheres are cut into triangles. */
#include "model.h"

#include <stdio.h>
#include <stdlib.h>

#define LEVELS 5

/* The unit sphere as an icosahedron whose faces were split in four so many times. */
struct ball {
    uint32_t vertex_count;
    uint32_t triangle_count;
    struct vector *vertices;
    uint32_t (*triangles)[3];
};

static uint32_t split_edge(struct ball *ball, uint32_t (*seen)[2][6], uint32_t *seen_count, uint32_t a, uint32_t b) {
    /* Each edge belongs to two triangles and must get one middle, or the ball would not be closed. The lower end
     * keeps the middles of its edges: at most six, because no vertex of such a ball has more neighbours. */
    const uint32_t low = a < b ? a : b;
    const uint32_t high = a < b ? b : a;
    for (uint32_t i = 0; i < seen_count[low]; ++i)
        if (seen[low][0][i] == high) return seen[low][1][i];
    const uint32_t middle = ball->vertex_count++;
    ball->vertices[middle] = vector_unit(vector_add(ball->vertices[a], ball->vertices[b]));
    seen[low][0][seen_count[low]] = high;
    seen[low][1][seen_count[low]++] = middle;
    return middle;
}

static bool ball_make(struct ball *ball, uint32_t splits) {
    static const uint32_t faces[20][3] = {
        {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
        {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
        {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1},
    };
    const double golden = 0.5 * (1.0 + sqrt(5.0));
    const struct vector corners[12] = {
        {-1, golden, 0},  {1, golden, 0},  {-1, -golden, 0}, {1, -golden, 0}, {0, -1, golden},  {0, 1, golden},
        {0, -1, -golden}, {0, 1, -golden}, {golden, 0, -1},  {golden, 0, 1},  {-golden, 0, -1}, {-golden, 0, 1},
    };
    const size_t most = (size_t)20 << (2 * splits);
    ball->vertices = malloc((most / 2 + 2) * sizeof *ball->vertices);
    ball->triangles = malloc(most * sizeof *ball->triangles);
    uint32_t(*seen)[2][6] = malloc((most / 2 + 2) * sizeof *seen);
    uint32_t *seen_count = malloc((most / 2 + 2) * sizeof *seen_count);
    const bool enough = ball->vertices != NULL && ball->triangles != NULL && seen != NULL && seen_count != NULL;
    if (enough) {
        ball->vertex_count = 12;
        ball->triangle_count = 20;
        for (int i = 0; i < 12; ++i) ball->vertices[i] = vector_unit(corners[i]);
        for (int i = 0; i < 20; ++i)
            for (int k = 0; k < 3; ++k) ball->triangles[i][k] = faces[i][k];
        for (uint32_t split = 0; split < splits; ++split) {
            for (uint32_t i = 0; i < ball->vertex_count; ++i) seen_count[i] = 0;
            const uint32_t old = ball->triangle_count;
            for (uint32_t i = 0; i < old; ++i) {
                const uint32_t a = ball->triangles[i][0], b = ball->triangles[i][1], c = ball->triangles[i][2];
                const uint32_t ab = split_edge(ball, seen, seen_count, a, b);
                const uint32_t bc = split_edge(ball, seen, seen_count, b, c);
                const uint32_t ca = split_edge(ball, seen, seen_count, c, a);
                const uint32_t parts[4][3] = {{ab, bc, ca}, {a, ab, ca}, {b, bc, ab}, {c, ca, bc}};
                for (int p = 0; p < 4; ++p)
                    for (int k = 0; k < 3; ++k)
                        ball->triangles[p == 0 ? i : ball->triangle_count + (uint32_t)p - 1][k] = parts[p][k];
                ball->triangle_count += 3;
            }
        }
    }
    free(seen);
    free(seen_count);
    return enough;
}

static void add_ball(struct model *model, const struct ball *ball, struct vector center, double radius, uint8_t paint) {
    const uint32_t first = (uint32_t)model->vertex_count;
    for (uint32_t i = 0; i < ball->vertex_count; ++i) {
        const struct vector p = vector_add(center, vector_scale(ball->vertices[i], radius));
        float *at = model->own_vertices + 3 * model->vertex_count++;
        at[0] = (float)p.x;
        at[1] = (float)p.y;
        at[2] = (float)p.z;
    }
    for (uint32_t i = 0; i < ball->triangle_count; ++i) {
        uint32_t *at = model->own_indices + 3 * model->triangle_count;
        for (int k = 0; k < 3; ++k) at[k] = first + ball->triangles[i][k];
        model->own_paint[model->triangle_count++] = paint;
    }
}

/* Turns v the shortest way that takes the z axis to the unit vector `axis`. */
static struct vector turn_to(struct vector axis, struct vector v) {
    const struct vector k = {-axis.y, axis.x, 0.0}; /* z cross axis: sine times the axis to turn about */
    const double sine2 = vector_dot(k, k);
    if (sine2 < 1e-24) return axis.z > 0.0 ? v : (struct vector){v.x, -v.y, -v.z};
    const struct vector turned = vector_add(vector_scale(v, axis.z), vector_cross(k, v));
    return vector_add(turned, vector_scale(k, vector_dot(k, v) * (1.0 - axis.z) / sine2));
}

static void add_flake(struct model *model, const struct ball *balls, uint32_t level, uint32_t levels,
                      struct vector center, double radius, struct vector axis) {
    add_ball(model, &balls[level], center, radius, (uint8_t)level);
    if (level + 1 == levels) return;
    const double degree = 3.14159265358979323846 / 180.0;
    for (int i = 0; i < 9; ++i) {
        const bool high = i < 3;
        const double azimuth = (high ? 45.0 + 120.0 * i : 15.0 + 60.0 * (i - 3)) * degree;
        const double z = high ? sqrt(2.0 / 3.0) : 0.0;
        const double flat = sqrt(1.0 - z * z);
        const struct vector away = turn_to(axis, (struct vector){flat * cos(azimuth), flat * sin(azimuth), z});
        const struct vector child = vector_add(center, vector_scale(away, radius * 4.0 / 3.0));
        add_flake(model, balls, level + 1, levels, child, radius / 3.0, away);
    }
}

bool model_sphereflake(struct model *model, uint32_t detail) {
    /* Large balls get more triangles than small ones, so that all look round from where the camera stands. With five
     * levels that makes 534,740 triangles on 7,381 balls. */
    struct ball balls[LEVELS] = {{0, 0, NULL, NULL}};
    const uint32_t levels = detail < LEVELS ? detail : LEVELS;
    uint64_t vertices = 0;
    uint64_t triangles = 0;
    uint64_t count = 1;
    bool made = true;
    for (uint32_t level = 0; made && level < levels; ++level, count *= 9) {
        made = ball_make(&balls[level], level < 4 ? 5 - level : 0);
        vertices += count * balls[level].vertex_count;
        triangles += count * balls[level].triangle_count;
    }
    if (!made) fprintf(stderr, "raywise-demo: out of memory for the sphereflake\n");
    made = made && model_reserve(model, vertices, triangles);
    if (made) {
        add_flake(model, balls, 0, levels, (struct vector){0, 0, 0}, 0.5, (struct vector){0, 0, 1});
        model_finish(model);
        snprintf(model->title, sizeof model->title, "sphereflake of %u levels", (unsigned)levels);
        model->up = MODEL_UP_Z;
        model->wants_ground = true;
        model->ground = -INFINITY;
        model->ground_colour = (struct vector){0.64, 0.63, 0.61};
        model->palette[0] = (struct vector){0.55, 0.11, 0.07};
        model->palette[1] = (struct vector){0.75, 0.32, 0.07};
        model->palette[2] = (struct vector){0.80, 0.58, 0.20};
        model->palette[3] = (struct vector){0.30, 0.50, 0.42};
        model->palette[4] = (struct vector){0.10, 0.27, 0.45};
    }
    for (uint32_t level = 0; level < LEVELS; ++level) {
        free(balls[level].vertices);
        free(balls[level].triangles);
    }
    return made;
}
