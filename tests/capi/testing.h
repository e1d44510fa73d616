/* The few lines a C test needs: checks that say where they failed, and scenes to ask. */
#ifndef RAYWISE_TESTS_CAPI_TESTING_H
#define RAYWISE_TESTS_CAPI_TESTING_H

#include "raywise/raywise.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures;
static int checks;

static int check_that(int holds, const char *what, const char *file, int line) {
    ++checks;
    if (!holds) {
        ++failures;
        fprintf(stderr, "%s:%d: %s\n    last error: %s\n", file, line, what, rw_last_error_message());
    }
    return holds;
}

#define CHECK(condition) check_that((condition) != 0, #condition, __FILE__, __LINE__)
#define CHECK_OK(call) check_that((call) == RW_OK, #call, __FILE__, __LINE__)

/* Stops the program when nothing can be tested without it. */
#define NEED_OK(call)                                                         \
    do {                                                                      \
        if (!check_that((call) == RW_OK, #call, __FILE__, __LINE__)) exit(1); \
    } while (0)

/* A status, and every part of the message, parts separated by '|'. */
static int check_error(int32_t status, int32_t wanted, const char *parts, const char *what, const char *file,
                       int line) {
    char text[256];
    char *part = text;
    int good = status == wanted;
    ++checks;
    strncpy(text, parts, sizeof text - 1);
    text[sizeof text - 1] = '\0';
    while (good && part != NULL) {
        char *end = strchr(part, '|');
        if (end != NULL) *end++ = '\0';
        good = strstr(rw_last_error_message(), part) != NULL;
        if (good) part = end;
    }
    if (!good) {
        ++failures;
        fprintf(stderr, "%s:%d: %s\n    status %d (%s), wanted %d and \"%s\"\n    message: %s\n", file, line, what,
                (int)status, rw_status_text(status), (int)wanted, parts, rw_last_error_message());
    }
    return good;
}

#define CHECK_ERROR(call, status, parts) check_error((call), (status), (parts), #call, __FILE__, __LINE__)

static int finish(const char *name) {
    printf("%s: %d checks, %d failed\n", name, checks, failures);
    return failures == 0 ? 0 : 1;
}

/* Numbers from a seed, the same everywhere. */
static uint64_t random_state = 88172645463325252u;
static double random_number(double low, double high) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return low + (high - low) * ((double)(random_state >> 11) * (1.0 / 9007199254740992.0));
}

/* Triangles strewn in the cube from -1 to 1, the same for the same count. */
typedef struct soup {
    uint64_t triangles;
    float *vertices;   /* 9 for each triangle */
    uint32_t *indices; /* 3 for each triangle */
} soup;

static soup make_soup(uint64_t triangles) {
    soup s;
    uint64_t i;
    int corner, axis;
    uint64_t before = random_state;
    random_state = 1234567;
    s.triangles = triangles;
    s.vertices = (float *)malloc((size_t)triangles * 9 * sizeof(float) + 1);
    s.indices = (uint32_t *)malloc((size_t)triangles * 3 * sizeof(uint32_t) + 1);
    if (s.vertices == NULL || s.indices == NULL) exit(1);
    for (i = 0; i < triangles; ++i) {
        double center[3];
        for (axis = 0; axis < 3; ++axis) center[axis] = random_number(-1.0, 1.0);
        for (corner = 0; corner < 3; ++corner) {
            for (axis = 0; axis < 3; ++axis)
                s.vertices[9 * i + 3 * corner + axis] = (float)(center[axis] + random_number(-0.2, 0.2));
            s.indices[3 * i + corner] = (uint32_t)(3 * i + corner);
        }
    }
    random_state = before;
    return s;
}

static void free_soup(soup *s) {
    free(s->vertices);
    free(s->indices);
}

static rw_triangles triangles_of(const soup *s) {
    rw_triangles t;
    memset(&t, 0, sizeof t);
    t.struct_size = sizeof t;
    t.vertex_count = 3 * s->triangles;
    t.vertices.data = s->vertices;
    t.triangle_count = s->triangles;
    t.indices.data = s->indices;
    return t;
}

/* A scene of a soup, committed on the structure named; NULL: the library chooses. */
static rw_scene *make_scene(const soup *s, const char *structure) {
    rw_scene *scene = NULL;
    const rw_triangles t = triangles_of(s);
    NEED_OK(rw_scene_create(NULL, &scene));
    NEED_OK(rw_scene_add_triangles(scene, &t, NULL));
    NEED_OK(rw_scene_set_structure(scene, structure));
    NEED_OK(rw_scene_commit(scene, NULL));
    return scene;
}

static rw_ray random_ray(void) {
    rw_ray ray;
    int axis;
    for (axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = random_number(-1.5, 1.5);
        ray.direction[axis] = random_number(-1.0, 1.0);
    }
    ray.tmin = 0.0;
    ray.tmax = INFINITY;
    return ray;
}

/* Not every program uses every helper. */
static void use_all_helpers(void) {
    (void)make_soup;
    (void)make_scene;
    (void)random_ray;
    (void)free_soup;
    (void)check_error;
    (void)finish;
    (void)use_all_helpers;
}

#endif
