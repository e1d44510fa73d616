/* The smallest useful program: opens libraywise at run time, traces two rays against a cube, checks the answers.
 *
 *     closest_hit [path of libraywise.so.1]
 *
 * Exit code: 0 right answers, 1 wrong ones, 2 no library or a failing call. */
#include <dlfcn.h>
#include <math.h>
#include <raywise/raywise.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *library;

/* The function of that name, copied into *function: ISO C cannot convert the pointer itself. */
static void find(const char *name, void *function) {
    void *symbol = dlsym(library, name);
    if (symbol == NULL) {
        fprintf(stderr, "closest_hit: the library has no %s\n", name);
        exit(2);
    }
    memcpy(function, &symbol, sizeof symbol);
}

static const char *(*last_error_message)(void);

static void check(int32_t status, const char *call) {
    if (status == RW_OK) return;
    fprintf(stderr, "closest_hit: %s: %s\n", call, last_error_message());
    exit(2);
}

int main(int argc, char **argv) {
    /* Two triangles a side, seen from outside counter-clockwise, as indices into the eight corners. */
    static const float vertices[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                         {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
    static const uint32_t indices[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                            {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

    library = dlopen(argc > 1 ? argv[1] : "libraywise.so.1", RTLD_NOW);
    if (library == NULL) {
        fprintf(stderr, "closest_hit: %s\n", dlerror());
        return 2;
    }
    int32_t (*create)(const rw_profile *, rw_scene **);
    int32_t (*add_triangles)(rw_scene *, const rw_triangles *, uint32_t *);
    int32_t (*commit)(rw_scene *, const rw_commit_options *);
    int32_t (*intersect)(const rw_scene *, const rw_ray *, const rw_ray_options *, rw_hit *);
    int32_t (*normal_of)(const rw_scene *, const rw_hit *, double *);
    int32_t (*release)(const rw_scene *);
    find("rw_last_error_message", &last_error_message);
    find("rw_scene_create", &create);
    find("rw_scene_add_triangles", &add_triangles);
    find("rw_scene_commit", &commit);
    find("rw_scene_intersect", &intersect);
    find("rw_scene_normal", &normal_of);
    find("rw_scene_release", &release);

    rw_scene *scene = NULL;
    const rw_triangles cube = {.struct_size = sizeof cube,
                               .vertex_count = 8,
                               .vertices = {.data = vertices},
                               .triangle_count = 12,
                               .indices = {.data = indices}};
    check(create(NULL, &scene), "rw_scene_create");
    check(add_triangles(scene, &cube, NULL), "rw_scene_add_triangles");
    check(commit(scene, NULL), "rw_scene_commit");

    /* From above onto the side z = 1, into its first triangle; and past the cube. */
    const rw_ray down = {.origin = {-0.5, -0.25, 5}, .direction = {0, 0, -1}, .tmax = INFINITY};
    const rw_ray past = {.origin = {3, 0, 5}, .direction = {0, 0, -1}, .tmax = INFINITY};
    rw_hit hit, miss;
    check(intersect(scene, &down, NULL, &hit), "rw_scene_intersect");
    check(intersect(scene, &past, NULL, &miss), "rw_scene_intersect");
    double normal[3];
    check(normal_of(scene, &hit, normal), "rw_scene_normal");
    check(release(scene), "rw_scene_release");

    printf("down: triangle %u at t = %g, normal %g %g %g\n", (unsigned)hit.primitive, hit.t, normal[0], normal[1],
           normal[2]);
    printf("past: %s\n", miss.primitive == RW_INVALID_ID ? "no hit" : "a hit");
    const int right = hit.primitive == 2 && hit.geometry == 0 && hit.t == 4.0 && hit.u == 0.25 && hit.v == 0.375 &&
                      normal[2] == 1.0 && miss.primitive == RW_INVALID_ID && isinf(miss.t);
    puts(right ? "right" : "WRONG");
    return right ? 0 : 1;
}
