/* Single rays in float32: the float64 answers to the same numbers, rounded. */
#include "testing.h"

#include <float.h>

#define ROOM 64
#define SMALLEST 1.4e-45f /* FLT_TRUE_MIN is younger than C99 */

static rw_ray widened(const rw_ray_f32 *ray) {
    rw_ray wide;
    int axis;
    for (axis = 0; axis < 3; ++axis) {
        wide.origin[axis] = ray->origin[axis];
        wide.direction[axis] = ray->direction[axis];
    }
    wide.tmin = ray->tmin;
    wide.tmax = ray->tmax;
    return wide;
}

static int same_float(float a, float b) { return memcmp(&a, &b, sizeof a) == 0; }

static int is_rounded(const rw_hit_f32 *hit, const rw_hit *wide) {
    return same_float(hit->t, (float)wide->t) && same_float(hit->u, (float)wide->u) &&
           same_float(hit->v, (float)wide->v) && hit->instance == wide->instance && hit->geometry == wide->geometry &&
           hit->primitive == wide->primitive;
}

/* All three questions in both precisions. Returns how many hits there are. */
static uint64_t compare(const rw_scene *scene, const rw_ray_f32 *ray, const rw_ray_options *options) {
    const rw_ray wide = widened(ray);
    rw_hit right, all_right[ROOM];
    rw_hit_f32 hit, all[ROOM];
    int32_t occluded = 7, right_occluded = 8;
    uint64_t needed = 77, right_needed = 78, i;
    CHECK_OK(rw_scene_intersect(scene, &wide, options, &right));
    CHECK_OK(rw_scene_intersect_f32(scene, ray, options, &hit));
    CHECK(is_rounded(&hit, &right));
    CHECK_OK(rw_scene_occluded(scene, &wide, options, &right_occluded));
    CHECK_OK(rw_scene_occluded_f32(scene, ray, options, &occluded));
    CHECK(occluded == right_occluded && occluded == (hit.primitive != RW_INVALID_ID));
    CHECK_OK(rw_scene_intersect_all(scene, &wide, options, all_right, ROOM, &right_needed));
    CHECK_OK(rw_scene_intersect_all_f32(scene, ray, options, all, ROOM, &needed));
    CHECK(needed == right_needed);
    for (i = 0; i < needed; ++i) CHECK(is_rounded(&all[i], &all_right[i]));
    /* Rounding is monotonic, so t cannot leave an interval whose ends are float32. */
    if (hit.primitive != RW_INVALID_ID) CHECK(hit.t >= ray->tmin && hit.t <= ray->tmax);
    return needed;
}

static rw_ray_f32 narrow_ray(void) {
    const rw_ray wide = random_ray();
    rw_ray_f32 ray;
    int axis;
    for (axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = (float)wide.origin[axis];
        ray.direction[axis] = (float)wide.direction[axis];
    }
    ray.tmin = 0.0f;
    ray.tmax = INFINITY;
    return ray;
}

static void answers_are_rounded(const rw_scene *scene) {
    uint64_t hits = 0;
    int i;
    for (i = 0; i < 500; ++i) {
        rw_ray_f32 ray = narrow_ray();
        rw_hit_f32 hit;
        hits += compare(scene, &ray, NULL);
        CHECK_OK(rw_scene_intersect_f32(scene, &ray, NULL, &hit));
        if (hit.primitive == RW_INVALID_ID) continue;
        /* Intervals that end at, right before and right behind the rounded t. */
        ray.tmax = hit.t;
        compare(scene, &ray, NULL);
        ray.tmax = nextafterf(hit.t, 0.0f);
        compare(scene, &ray, NULL);
        ray.tmax = INFINITY;
        ray.tmin = hit.t;
        compare(scene, &ray, NULL);
        ray.tmin = nextafterf(hit.t, INFINITY);
        compare(scene, &ray, NULL);
    }
    CHECK(hits > 100);
}

static void skips_what_it_is_told_to(const rw_scene *scene) {
    int i, skipped = 0;
    for (i = 0; i < 200; ++i) {
        const rw_ray_f32 ray = narrow_ray();
        rw_primitive_id id;
        rw_ray_options options;
        rw_hit_f32 first, second;
        memset(&options, 0, sizeof options);
        options.struct_size = sizeof options;
        compare(scene, &ray, &options);
        CHECK_OK(rw_scene_intersect_f32(scene, &ray, &options, &first));
        if (first.primitive == RW_INVALID_ID) continue;
        id.instance = first.instance;
        id.geometry = first.geometry;
        id.primitive = first.primitive;
        options.skip = &id;
        options.skip_count = 1;
        compare(scene, &ray, &options);
        CHECK_OK(rw_scene_intersect_f32(scene, &ray, &options, &second));
        CHECK(second.primitive != first.primitive && second.t >= first.t);
        ++skipped;
    }
    CHECK(skipped > 10);
}

static void is_miss(const rw_scene *scene, const rw_ray_f32 *ray) {
    rw_hit_f32 hit;
    CHECK(compare(scene, ray, NULL) == 0);
    CHECK_OK(rw_scene_intersect_f32(scene, ray, NULL, &hit));
    CHECK(hit.t == INFINITY && hit.u == 0.0f && hit.v == 0.0f && hit.instance == RW_INVALID_ID &&
          hit.geometry == RW_INVALID_ID && hit.primitive == RW_INVALID_ID);
}

/* A number of a ray: 0 to 2 the origin, 3 tmin, 4 to 6 the direction, 7 tmax. */
static float *number_of(rw_ray_f32 *ray, int which) {
    return which < 3    ? &ray->origin[which]
           : which == 3 ? &ray->tmin
           : which < 7  ? &ray->direction[which - 4]
                        : &ray->tmax;
}

static void odd_numbers_are_misses(const rw_scene *scene, const rw_ray_f32 *good) {
    rw_scene_statistics before, after;
    rw_ray_f32 ray = *good;
    int which, nans = 0;
    before.struct_size = after.struct_size = sizeof before;
    CHECK(compare(scene, &ray, NULL) > 0);
    CHECK_OK(rw_scene_get_statistics(scene, &before));
    for (which = 0; which < 8; ++which) {
        ray = *good;
        *number_of(&ray, which) = NAN;
        is_miss(scene, &ray);
        nans += 7; /* compare() asks six times, is_miss() once more */
        ray = *good;
        *number_of(&ray, which) = which == 7 ? -INFINITY : INFINITY;
        is_miss(scene, &ray);
    }
    CHECK_OK(rw_scene_get_statistics(scene, &after));
    CHECK(after.invalid_rays - before.invalid_rays == (uint64_t)nans);
    ray = *good;
    ray.direction[0] = ray.direction[1] = ray.direction[2] = 0.0f;
    is_miss(scene, &ray);
    ray = *good;
    ray.tmin = 2.0f;
    ray.tmax = 1.0f;
    is_miss(scene, &ray);
    ray = *good;
    ray.tmin = -INFINITY;
    CHECK(compare(scene, &ray, NULL) > 0);
}

/* One triangle across the z axis at height 1. */
static rw_scene *make_gate(void) {
    static const float vertices[9] = {-4, -4, 1, 4, -4, 1, 0, 4, 1};
    rw_triangles t;
    rw_scene *scene = NULL;
    memset(&t, 0, sizeof t);
    t.struct_size = sizeof t;
    t.vertex_count = 3;
    t.vertices.data = vertices;
    t.triangle_count = 1;
    NEED_OK(rw_scene_create(NULL, &scene));
    NEED_OK(rw_scene_add_triangles(scene, &t, NULL));
    NEED_OK(rw_scene_commit(scene, NULL));
    return scene;
}

static void ends_of_float32(void) {
    rw_scene *scene = make_gate();
    rw_ray_f32 ray = {{0, 0, 0}, 0, {0, 0, 1}, INFINITY};
    rw_hit_f32 hit;
    odd_numbers_are_misses(scene, &ray);

    ray.tmin = -FLT_MAX;
    ray.tmax = FLT_MAX;
    CHECK(compare(scene, &ray, NULL) == 1);
    ray.tmin = FLT_MAX;
    is_miss(scene, &ray);
    ray.tmin = ray.tmax = 1.0f;
    CHECK(compare(scene, &ray, NULL) == 1);
    ray.tmin = SMALLEST;
    CHECK(compare(scene, &ray, NULL) == 1);
    ray.tmax = SMALLEST;
    is_miss(scene, &ray);

    /* The shortest direction there is: t is beyond float32, and it is a hit all the same, unless tmax says otherwise. */
    ray.direction[2] = SMALLEST;
    ray.tmin = 0.0f;
    ray.tmax = INFINITY;
    CHECK(compare(scene, &ray, NULL) == 1);
    CHECK_OK(rw_scene_intersect_f32(scene, &ray, NULL, &hit));
    CHECK(hit.t == INFINITY && hit.primitive == 0);
    ray.tmax = FLT_MAX;
    is_miss(scene, &ray);
    /* The longest: t is denormal. */
    ray.direction[2] = FLT_MAX;
    ray.tmax = INFINITY;
    CHECK(compare(scene, &ray, NULL) == 1);
    CHECK_OK(rw_scene_intersect_f32(scene, &ray, NULL, &hit));
    CHECK(hit.t > 0.0f && hit.t < FLT_MIN && hit.primitive == 0);
    rw_scene_release(scene);
}

static void capacity(const rw_scene *scene) {
    rw_ray_f32 ray = narrow_ray();
    rw_hit_f32 hits[ROOM], blank;
    uint64_t needed = 0, again = 0;
    memset(&blank, 0x5A, sizeof blank);
    while (CHECK_OK(rw_scene_intersect_all_f32(scene, &ray, NULL, NULL, 0, &needed)) && needed < 3) ray = narrow_ray();
    hits[2] = blank;
    CHECK_ERROR(rw_scene_intersect_all_f32(scene, &ray, NULL, hits, 2, &again), RW_ERROR_CAPACITY,
                "hits|capacity is 2");
    CHECK(again == needed && memcmp(&hits[2], &blank, sizeof blank) == 0);
    CHECK(hits[0].primitive != RW_INVALID_ID && hits[0].t <= hits[1].t);
}

int main(void) {
    soup s = make_soup(400);
    uint32_t structures = 0, i;
    use_all_helpers();
    CHECK(sizeof(rw_ray_f32) == 32 && sizeof(rw_hit_f32) == 24 && sizeof(rw_ray) == 64 && sizeof(rw_hit) == 40);
    NEED_OK(rw_structure_count(&structures));
    for (i = 0; i < structures; ++i) {
        const char *name = NULL;
        rw_scene *scene;
        NEED_OK(rw_structure_name(i, &name));
        scene = make_scene(&s, name);
        answers_are_rounded(scene);
        skips_what_it_is_told_to(scene);
        capacity(scene);
        rw_scene_release(scene);
    }
    ends_of_float32();
    free_soup(&s);
    return finish("float32");
}
