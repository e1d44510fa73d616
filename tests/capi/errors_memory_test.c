/* What the caller's structs may not hold: reserved members that are not zero, outputs whose bytes belong to something else as well.
 * Each has a status of its own, a message that names the members, and leaves everything as it was. */
#include "errors_testing.h"

enum {
    COUNT = 5
};

/* All that a batch can be given, in memory of its own. */
static struct batch {
    double origin[3 * COUNT], direction[3 * COUNT], tmin[COUNT], tmax[COUNT];
    uint64_t skip_offsets[COUNT + 1];
    uint32_t skip_geometry[2 * COUNT], skip_primitive[2 * COUNT];
    double t[COUNT], uv[2 * COUNT], normal[3 * COUNT];
    uint32_t instance[COUNT], geometry[COUNT], primitive[COUNT];
    uint64_t offsets[COUNT + 1], needed, between[COUNT], invalid;
    uint8_t occluded[COUNT];
    rw_rays rays;
    rw_hits hits;
    rw_output flags;
    rw_query_options options;
} b;

static void set_input(rw_array *array, const void *data, int32_t type) {
    memset(array, 0, sizeof *array);
    array->data = data;
    array->type = type;
}
static void set_output(rw_output *output, void *data, int32_t type) {
    memset(output, 0, sizeof *output);
    output->data = data;
    output->type = type;
}

static void make_batch(void) {
    int i;
    memset(&b, 0, sizeof b);
    for (i = 0; i < COUNT; ++i) {
        b.origin[3 * i] = 0.1 * i;
        b.origin[3 * i + 2] = -5;
        b.direction[3 * i + 2] = 1;
        b.tmax[i] = INFINITY;
        b.skip_offsets[i + 1] = 2 * (uint64_t)(i + 1);
    }
    b.rays.struct_size = sizeof b.rays;
    b.rays.count = COUNT;
    set_input(&b.rays.origin, b.origin, RW_FLOAT64);
    set_input(&b.rays.direction, b.direction, RW_FLOAT64);
    set_input(&b.rays.tmin, b.tmin, RW_FLOAT64);
    set_input(&b.rays.tmax, b.tmax, RW_FLOAT64);
    b.rays.skip_offsets = b.skip_offsets;
    set_input(&b.rays.skip_geometry, b.skip_geometry, RW_UINT32);
    set_input(&b.rays.skip_primitive, b.skip_primitive, RW_UINT32);
    b.hits.struct_size = sizeof b.hits;
    set_output(&b.hits.t, b.t, RW_FLOAT64);
    set_output(&b.hits.uv, b.uv, RW_FLOAT64);
    set_output(&b.hits.normal, b.normal, RW_FLOAT64);
    set_output(&b.hits.instance, b.instance, RW_UINT32);
    set_output(&b.hits.geometry, b.geometry, RW_UINT32);
    set_output(&b.hits.primitive, b.primitive, RW_UINT32);
    set_output(&b.flags, b.occluded, RW_UINT8);
    b.options.struct_size = sizeof b.options;
    b.options.invalid_rays = &b.invalid;
}

/* Every call that takes the batch. */
static int32_t intersect(void) { return rw_scene_intersect_batch(committed, &b.rays, &b.hits, &b.options); }
static int32_t occlude(void) { return rw_scene_occluded_batch(committed, &b.rays, &b.flags, &b.options); }
static int32_t intersect_all(void) {
    return rw_scene_intersect_all_batch(committed, &b.rays, b.offsets, &b.hits, COUNT, &b.needed, &b.options);
}
static int32_t view_intersect(void) { return rw_scene_intersect_batch(view, &b.rays, &b.hits, &b.options); }
static int32_t view_occlude(void) { return rw_scene_occluded_batch(view, &b.rays, &b.flags, &b.options); }
static int32_t view_intersect_all(void) {
    return rw_scene_intersect_all_batch(view, &b.rays, b.offsets, &b.hits, COUNT, &b.needed, &b.options);
}
static int32_t once_intersect(void) {
    const rw_triangles t = triangles_of(&s);
    rw_once_options once;
    memset(&once, 0, sizeof once);
    once.struct_size = sizeof once;
    once.query = &b.options;
    return rw_once_intersect(&t, 1, &b.rays, &b.hits, &once);
}
static int32_t once_occlude(void) {
    const rw_triangles t = triangles_of(&s);
    rw_once_options once;
    memset(&once, 0, sizeof once);
    once.struct_size = sizeof once;
    once.query = &b.options;
    return rw_once_occluded(&t, 1, &b.rays, &b.flags, &once);
}
static int32_t expect_sample(void) {
    rw_expected_rays expected;
    memset(&expected, 0, sizeof expected);
    expected.struct_size = sizeof expected;
    expected.count = 1;
    expected.sample = &b.rays;
    return rw_scene_set_expected_rays(fresh, &expected);
}

typedef int32_t (*call)(void);
#define FOR_EACH(i, table) for (i = 0; i < sizeof table / sizeof table[0]; ++i)

/* ---- reserved members ----------------------------------------------------------------------------- */

static int32_t refused_reserved(int32_t *reserved, call which, const char *name) {
    static const int32_t values[] = {1, -1, 3, INT32_MIN};
    char parts[100];
    size_t i;
    FOR_EACH(i, values) {
        *reserved = values[i];
        snprintf(parts, sizeof parts, "%s.reserved: it is %d, not 0", name, (int)values[i]);
        if (!CHECK_ERROR(which(), RW_ERROR_RESERVED, parts)) fprintf(stderr, "    %s\n", name);
    }
    *reserved = 0;
    return CHECK(which() != RW_ERROR_RESERVED);
}

static rw_triangles mesh_in;
static int32_t add_mesh(void) { return rw_scene_add_triangles(fresh, &mesh_in, NULL); }
static int32_t refit_mesh(void) {
    rw_scene *refitted = NULL;
    const int32_t status = rw_scene_refit(committed, &mesh_in, 1, NULL, &refitted);
    rw_scene_release(refitted);
    return status;
}
static int32_t once_mesh(void) { return rw_once_intersect(&mesh_in, 1, &b.rays, &b.hits, NULL); }
static rw_view_options view_options;
static int32_t make_view(void) {
    rw_scene *made = NULL;
    const int32_t status = rw_scene_view(committed, &view_options, NULL, &made);
    rw_scene_release(made);
    return status;
}

static void reserved_members(void) {
    static const call asking[] = {intersect,          occlude,        intersect_all, view_intersect, view_occlude,
                                  view_intersect_all, once_intersect, once_occlude};
    static const call with_hits[] = {intersect, intersect_all, view_intersect, view_intersect_all, once_intersect};
    static const call with_flags[] = {occlude, view_occlude, once_occlude};
    size_t i;
    make_batch();
#define RAYS_MEMBER(member, prefix, which) refused_reserved(&b.rays.member.reserved, which, prefix #member)
#define ALL_OF_RAYS(prefix, which)             \
    RAYS_MEMBER(origin, prefix, which);        \
    RAYS_MEMBER(direction, prefix, which);     \
    RAYS_MEMBER(tmin, prefix, which);          \
    RAYS_MEMBER(tmax, prefix, which);          \
    RAYS_MEMBER(skip_geometry, prefix, which); \
    RAYS_MEMBER(skip_primitive, prefix, which)
    FOR_EACH(i, asking) { ALL_OF_RAYS("rays.", asking[i]); }
    ALL_OF_RAYS("expected.sample.", expect_sample);
    FOR_EACH(i, with_hits) {
        refused_reserved(&b.hits.t.reserved, with_hits[i], "hits.t");
        refused_reserved(&b.hits.uv.reserved, with_hits[i], "hits.uv");
        refused_reserved(&b.hits.normal.reserved, with_hits[i], "hits.normal");
        refused_reserved(&b.hits.instance.reserved, with_hits[i], "hits.instance");
        refused_reserved(&b.hits.geometry.reserved, with_hits[i], "hits.geometry");
        refused_reserved(&b.hits.primitive.reserved, with_hits[i], "hits.primitive");
        b.hits.normal.data = NULL; /* an output that is not wanted is no place for secrets either */
        refused_reserved(&b.hits.normal.reserved, with_hits[i], "hits.normal");
        b.hits.normal.data = b.normal;
    }
    FOR_EACH(i, with_flags) { refused_reserved(&b.flags.reserved, with_flags[i], "occluded"); }
    mesh_in = triangles_of(&s);
    refused_reserved(&mesh_in.vertices.reserved, refit_mesh, "meshes[0].vertices");
    refused_reserved(&mesh_in.indices.reserved, refit_mesh, "meshes[0].indices");
    refused_reserved(&mesh_in.vertices.reserved, once_mesh, "triangles.vertices");
    refused_reserved(&mesh_in.indices.reserved, once_mesh, "triangles.indices");
    mesh_in.vertices.reserved = 5;
    CHECK_ERROR(add_mesh(), RW_ERROR_RESERVED, "triangles.vertices.reserved: it is 5");
    mesh_in.vertices.reserved = 0;
    mesh_in.indices.reserved = 5;
    CHECK_ERROR(add_mesh(), RW_ERROR_RESERVED, "triangles.indices.reserved: it is 5");
    memset(&view_options, 0, sizeof view_options);
    view_options.struct_size = sizeof view_options;
    view_options.count = 10;
    refused_reserved(&view_options.reserved, make_view, "options");
}

/* The library hands out zeros in them. */
static void reserved_results(void) {
    const rw_ray ray = random_ray();
    rw_hit hit;
    rw_profile_info info;
    memset(&hit, 0xFF, sizeof hit);
    memset(&info, 0xFF, sizeof info);
    info.struct_size = sizeof info;
    CHECK_OK(rw_scene_intersect(committed, &ray, NULL, &hit));
    CHECK_OK(rw_profile_inspect(profile, &info));
    CHECK(hit.reserved == 0 && info.reserved == 0);
}

/* ---- outputs that share memory -------------------------------------------------------------------- */

/* The call is refused as long as *place is what it is now. */
static void refused_shared(call which, const char *parts) {
    const struct batch before = b;
    CHECK_ERROR(which(), RW_ERROR_SHARED_MEMORY, parts);
    CHECK(memcmp(&before, &b, sizeof b) == 0);
    make_batch();
}

static void shared_outputs(void) {
    static const call with_hits[] = {intersect, intersect_all, view_intersect, view_intersect_all, once_intersect};
    static const call with_flags[] = {occlude, view_occlude, once_occlude};
    static const call counting[] = {intersect_all, view_intersect_all};
    size_t i;
    make_batch();
    FOR_EACH(i, with_hits) {
        CHECK(with_hits[i]() == RW_OK || with_hits[i]() == RW_ERROR_CAPACITY);
        b.hits.uv.data = b.hits.t.data;
        refused_shared(with_hits[i], "hits.t and hits.uv");
        b.hits.primitive.data = b.hits.geometry.data;
        refused_shared(with_hits[i], "hits.geometry and hits.primitive");
        b.hits.instance.data = (char *)b.normal + sizeof b.normal - 1; /* its first byte is the other's last */
        refused_shared(with_hits[i], "hits.normal and hits.instance");
        b.hits.t.data = b.origin; /* in place */
        refused_shared(with_hits[i], "rays.origin and hits.t");
        b.hits.t.data = b.tmax;
        refused_shared(with_hits[i], "rays.tmax and hits.t");
        b.hits.normal.data = b.direction;
        refused_shared(with_hits[i], "rays.direction and hits.normal");
        b.hits.geometry.data = b.skip_geometry + COUNT; /* the second half of it */
        refused_shared(with_hits[i], "rays.skip_geometry and hits.geometry");
        b.hits.primitive.data = b.skip_primitive + 2 * COUNT - 1; /* the last entry of the last ray's list */
        b.hits.primitive.stride = -4;
        refused_shared(with_hits[i], "rays.skip_primitive and hits.primitive");
        b.hits.t.data = b.skip_offsets + 1;
        refused_shared(with_hits[i], "rays.skip_offsets and hits.t");
        b.options.invalid_rays = (uint64_t *)(void *)&b.t[COUNT - 1];
        refused_shared(with_hits[i], "options.invalid_rays and hits.t");
    }
    FOR_EACH(i, with_flags) {
        CHECK_OK(with_flags[i]());
        b.flags.data = b.tmin;
        refused_shared(with_flags[i], "rays.tmin and occluded");
        b.flags.data = &b.invalid;
        refused_shared(with_flags[i], "options.invalid_rays and occluded");
    }
    FOR_EACH(i, counting) {
        b.hits.t.data = b.offsets + 1;
        refused_shared(counting[i], "offsets and hits.t");
        b.hits.primitive.data = &b.needed;
        refused_shared(counting[i], "needed and hits.primitive");
        b.options.invalid_rays = &b.needed;
        refused_shared(counting[i], "options.invalid_rays and needed");
        b.options.invalid_rays = &b.offsets[COUNT];
        refused_shared(counting[i], "options.invalid_rays and offsets");
    }
    {
        double corners[6] = {7, 7, 7, 7, 7, 7};
        CHECK_ERROR(rw_scene_bounds(committed, corners, corners), RW_ERROR_SHARED_MEMORY, "lower and upper");
        CHECK_ERROR(rw_scene_bounds(committed, corners + 2, corners), RW_ERROR_SHARED_MEMORY, "lower and upper");
        CHECK(corners[0] == 7 && corners[5] == 7);
        CHECK_OK(rw_scene_bounds(committed, corners + 3, corners));
        CHECK(corners[3] <= corners[0]);
    }
}

/* Members of one struct for each ray, forwards and backwards, padding included: legal, and right. */
typedef struct answer {
    float t;
    uint32_t primitive;
    float uv[2];
    double normal[3];
    uint32_t instance, geometry;
} answer;

static void alternating_outputs(void) {
    answer answers[COUNT];
    double plain_t[COUNT];
    int backwards, i;
    make_batch();
    CHECK_OK(intersect());
    memcpy(plain_t, b.t, sizeof plain_t);
    for (backwards = 0; backwards < 2; ++backwards) {
        answer *first = backwards ? answers + COUNT - 1 : answers;
        const int64_t stride = backwards ? -(int64_t)sizeof(answer) : (int64_t)sizeof(answer);
        set_output(&b.hits.t, &first->t, RW_FLOAT32);
        set_output(&b.hits.uv, first->uv, RW_FLOAT32);
        set_output(&b.hits.normal, first->normal, RW_FLOAT64);
        set_output(&b.hits.instance, &first->instance, RW_UINT32);
        set_output(&b.hits.geometry, &first->geometry, RW_UINT32);
        set_output(&b.hits.primitive, &first->primitive, RW_UINT32);
        b.hits.t.stride = b.hits.uv.stride = b.hits.normal.stride = stride;
        b.hits.instance.stride = b.hits.geometry.stride = b.hits.primitive.stride = stride;
        CHECK_OK(intersect());
        for (i = 0; i < COUNT; ++i)
            CHECK(answers[backwards ? COUNT - 1 - i : i].t == (float)plain_t[i] && first->instance == RW_INVALID_ID);
        /* One member too wide for its place. */
        b.hits.primitive.type = RW_UINT64;
        CHECK_ERROR(intersect(), RW_ERROR_SHARED_MEMORY, "hits.uv and hits.primitive");
        b.hits.primitive.type = RW_UINT32;
    }
    /* Rays and answers in one struct, and one origin for all in front of an output. */
    {
        struct {
            double origin[3];
            struct {
                double direction[3];
                double t;
            } each[COUNT];
        } both;
        make_batch();
        memcpy(both.origin, b.origin, sizeof both.origin);
        for (i = 0; i < COUNT; ++i) memcpy(both.each[i].direction, b.direction, sizeof both.each[i].direction);
        set_input(&b.rays.origin, both.origin, RW_FLOAT64);
        b.rays.origin.stride = RW_REPEAT;
        set_input(&b.rays.direction, both.each[0].direction, RW_FLOAT64);
        set_output(&b.hits.t, &both.each[0].t, RW_FLOAT64);
        b.rays.direction.stride = b.hits.t.stride = (int64_t)sizeof both.each[0];
        CHECK_OK(intersect());
        for (i = 0; i < COUNT; ++i) CHECK(both.each[i].t == plain_t[0]);
        b.hits.t.data = both.origin; /* which every ray reads, and the first answer would be written to */
        CHECK_ERROR(intersect(), RW_ERROR_SHARED_MEMORY, "rays.origin and hits.t");
    }
    /* No ray, no byte. */
    make_batch();
    b.rays.count = 0;
    b.hits.uv.data = b.hits.t.data;
    CHECK_OK(intersect());
}

int main(void) {
    set_up();
    reserved_members();
    reserved_results();
    shared_outputs();
    alternating_outputs();
    return tear_down("errors of memory");
}
