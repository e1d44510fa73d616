/* Every allocation of every call fails once: the status says so, and nothing has changed. The program brings a malloc
 * of its own that can refuse; glibc's functions behind it have these names. */
#include "testing.h"

extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *old, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);

static long allowed = -1; /* allocations until one is refused; negative: all are allowed */
static long asked;

/* The library is to find these. */
#define EXPORTED __attribute__((visibility("default")))

static int refused(void) {
    ++asked;
    if (allowed < 0) return 0;
    return allowed-- == 0;
}

EXPORTED void *malloc(size_t size) { return refused() ? NULL : __libc_malloc(size); }
EXPORTED void *calloc(size_t count, size_t size) { return refused() ? NULL : __libc_calloc(count, size); }
EXPORTED void *realloc(void *old, size_t size) { return refused() ? NULL : __libc_realloc(old, size); }
EXPORTED void *aligned_alloc(size_t alignment, size_t size) {
    return refused() ? NULL : __libc_memalign(alignment, size);
}

/* Runs `call` with its first, second ... allocation refused until it gets through. Tells how many were. */
#define REFUSE_EACH(call, unchanged)                                               \
    do {                                                                           \
        long refusal;                                                              \
        int32_t status = RW_ERROR_OUT_OF_MEMORY;                                   \
        for (refusal = 0; refusal < 100000; ++refusal) {                           \
            allowed = refusal;                                                     \
            status = (call);                                                       \
            if (allowed < 0 && status == RW_OK) { /* a refusal that did no harm */ \
                allowed = -1;                                                      \
                break;                                                             \
            }                                                                      \
            if (allowed >= 0) {                                                    \
                allowed = -1;                                                      \
                break;                                                             \
            }                                                                      \
            allowed = -1;                                                          \
            if (!CHECK_ERROR(status, RW_ERROR_OUT_OF_MEMORY, "memory")) break;     \
            if (!CHECK(unchanged)) break;                                          \
        }                                                                          \
        CHECK(status == RW_OK);                                                    \
        printf("%s: %ld refusals\n", #call, refusal);                              \
    } while (0)

static int still_open(const rw_scene *scene) {
    rw_scene_statistics statistics;
    statistics.struct_size = sizeof statistics;
    return rw_scene_get_statistics(scene, &statistics) == RW_ERROR_NOT_COMMITTED;
}

int main(void) {
    soup s = make_soup(300);
    const rw_triangles t = triangles_of(&s);
    rw_profile *profile = NULL;
    rw_commit_options one_thread;
    rw_query_options query;
    uint32_t structures = 0, i;
    use_all_helpers();
    memset(&one_thread, 0, sizeof one_thread);
    memset(&query, 0, sizeof query);
    one_thread.struct_size = sizeof one_thread;
    query.struct_size = sizeof query;
    one_thread.threads = query.threads = 1; /* the threading library allocates as it likes */

    REFUSE_EACH(rw_profile_load("/nowhere", &profile) == RW_PROFILE_NOT_FOUND ? RW_OK : RW_ERROR_OUT_OF_MEMORY,
                profile == NULL);
    rw_profile_release(profile);
    profile = NULL;
    REFUSE_EACH(rw_profile_load(NULL, &profile), profile == NULL);

    NEED_OK(rw_structure_count(&structures));
    for (i = 0; i < structures; ++i) {
        rw_scene *scene = NULL;
        rw_scene *expected = make_scene(&s, "linear_scan");
        rw_view *view = NULL;
        rw_view_options options;
        const char *name = NULL;
        rw_hit hits[400], hit, wanted;
        uint64_t needed = 0, offsets[3];
        uint32_t geometry = 99;
        int k;
        rw_ray rays_in[2];
        float t_out[800];
        rw_rays rays;
        rw_hits out;
        NEED_OK(rw_structure_name(i, &name));
        REFUSE_EACH(rw_scene_create(profile, &scene), scene == NULL);
        REFUSE_EACH(rw_scene_add_triangles(scene, &t, &geometry), geometry == 99 && still_open(scene));
        CHECK(geometry == 0);
        REFUSE_EACH(rw_scene_set_structure(scene, name), still_open(scene));
        REFUSE_EACH(rw_scene_commit(scene, &one_thread), still_open(scene));
        for (k = 0; k < 30; ++k) {
            const rw_ray ray = random_ray();
            CHECK_OK(rw_scene_intersect(scene, &ray, &hit));
            CHECK_OK(rw_scene_intersect(expected, &ray, &wanted));
            CHECK(memcmp(&hit, &wanted, sizeof hit) == 0);
        }
        rays_in[0] = random_ray();
        rays_in[1] = random_ray();
        REFUSE_EACH(rw_scene_intersect_all(scene, &rays_in[0], hits, 400, &needed), 1);
        REFUSE_EACH(rw_scene_intersect(scene, &rays_in[0], &hit), 1);
        memset(&rays, 0, sizeof rays);
        memset(&out, 0, sizeof out);
        rays.struct_size = sizeof rays;
        rays.count = 2;
        rays.origin.data = rays_in[0].origin;
        rays.origin.stride = sizeof(rw_ray);
        rays.origin.type = RW_FLOAT64;
        rays.direction = rays.origin;
        rays.direction.data = rays_in[0].direction;
        out.struct_size = sizeof out;
        out.t.data = t_out;
        REFUSE_EACH(rw_scene_intersect_batch(scene, &rays, &out, &query), 1);
        REFUSE_EACH(rw_scene_intersect_all_batch(scene, &rays, offsets, &out, 800, &needed, &query), 1);
        REFUSE_EACH(rw_scene_explain(scene, RW_FORMAT_JSON, NULL, 0, &needed), 1);
        memset(&options, 0, sizeof options);
        options.struct_size = sizeof options;
        options.count = 1000000;
        options.structure = name;
        REFUSE_EACH(rw_view_create(scene, &options, &one_thread, &view), view == NULL);
        CHECK_OK(rw_view_intersect(view, &rays_in[0], &hit));
        CHECK_OK(rw_scene_intersect(expected, &rays_in[0], &wanted));
        CHECK(memcmp(&hit, &wanted, sizeof hit) == 0);
        rw_view_release(view);
        rw_scene_release(scene);
        rw_scene_release(expected);
    }
    rw_profile_release(profile);
    CHECK(asked > 0);
    free_soup(&s);
    return finish("out of memory");
}
