/* A host that loads the library, works with it on several threads and closes it again, over and over:
 *   unload_test LIBRARY
 * The library's threads outlive the last call, and their code has to outlive dlclose. */
#define _GNU_SOURCE
#include "raywise/raywise.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum {
    ray_count = 4096
};

typedef int32_t once_function(const rw_triangles *, uint32_t, const rw_rays *, const rw_hits *,
                              const rw_once_options *);

static int ask(const char *path) {
    static const float triangle[9] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
    static const float origin[3] = {0, 0, 1};
    static const float direction[3] = {0, 0, -1};
    static float t[ray_count];
    rw_triangles mesh;
    rw_rays rays;
    rw_hits hits;
    once_function *once = NULL;
    void *symbol = NULL;
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    int i = 0;

    if (library == NULL || (symbol = dlsym(library, "rw_once_intersect")) == NULL) {
        fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    memcpy(&once, &symbol, sizeof once); /* C has no conversion from an object pointer to a function's */
    memset(&mesh, 0, sizeof mesh);
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    mesh.struct_size = sizeof mesh;
    mesh.vertex_count = 3;
    mesh.vertices.data = triangle;
    mesh.triangle_count = 1;
    rays.struct_size = sizeof rays;
    rays.count = ray_count;
    rays.origin.data = origin;
    rays.origin.stride = RW_REPEAT;
    rays.direction.data = direction;
    rays.direction.stride = RW_REPEAT;
    hits.struct_size = sizeof hits;
    hits.t.data = t;
    memset(t, 0, sizeof t);
    if (once(&mesh, 1, &rays, &hits, NULL) != RW_OK) return 1;
    for (i = 0; i < ray_count; ++i) {
        if (t[i] != 1.0f) return 1;
    }
    return dlclose(library);
}

int main(int argc, char **argv) {
    const struct timespec pause = {0, 50000000};
    int round = 0;
    if (argc != 2) return 2;
    for (round = 0; round < 10; ++round) {
        if (ask(argv[1]) != 0) return 1;
        nanosleep(&pause, NULL); /* time for a thread to find its code gone */
    }
    puts("loaded and closed 10 times");
    return 0;
}
