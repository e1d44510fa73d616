/* Batches in every layout: the same bits as one ray at a time. */
#include "testing.h"

#define COUNT 257

static rw_ray rays_in[COUNT];
static rw_hit wanted[COUNT];
static double wanted_normal[COUNT][3]; /* zero for a miss */
static rw_scene *scene;

/* Bytes whose every element lies at an odd address. */
static unsigned char input[COUNT * 400 + 64];
static unsigned char output[COUNT * 400 + 64];

typedef struct layout {
    const char *name;
    int64_t stride;           /* in elements' sizes; 0: packed */
    int64_t component_stride; /* in sizes; 0: packed */
    int64_t first;            /* in sizes */
} layout;

static const layout layouts[] = {
    {"array of structs", 0, 0, 0},
    {"array of structs with gaps", 5, 0, 0},
    {"struct of arrays", 1, COUNT, 0},
    {"backwards", -3, 0, 3 * (COUNT - 1)},
    {"struct of arrays, backwards", -1, COUNT, COUNT - 1},
    {"components backwards", 3, -1, 2},
    {"far apart", 11, 3, 4},
};

static void put_number(unsigned char *at, int32_t type, double value) {
    if (type == RW_FLOAT64) {
        memcpy(at, &value, sizeof value);
    } else {
        const float rounded = (float)value;
        memcpy(at, &rounded, sizeof rounded);
    }
}

static double get_number(const unsigned char *at, int32_t type) {
    double value;
    float rounded;
    if (type == RW_FLOAT64) {
        memcpy(&value, at, sizeof value);
        return value;
    }
    memcpy(&rounded, at, sizeof rounded);
    return (double)rounded;
}

static uint64_t get_id(const unsigned char *at, int32_t type) {
    uint64_t wide;
    uint32_t narrow;
    if (type == RW_UINT64) {
        memcpy(&wide, at, sizeof wide);
        return wide;
    }
    memcpy(&narrow, at, sizeof narrow);
    return narrow;
}

static int64_t size_of(int32_t type) { return type == RW_UINT8 ? 1 : type == RW_FLOAT32 || type == RW_UINT32 ? 4 : 8; }

static int64_t place(const layout *l, int64_t size, int components, int64_t element, int component) {
    const int64_t stride = l->stride == 0 ? components : l->stride;
    const int64_t between = l->component_stride == 0 ? 1 : l->component_stride;
    return (l->first + element * stride + component * between) * size;
}

static int same_number(double a, double b) { return memcmp(&a, &b, sizeof a) == 0; }
/* Through memory: GCC 12 at -O2 leaves the rounding of (double)(float)x out in one of the loops below. */
static double as_float(double value) {
    volatile float rounded = (float)value;
    return (double)rounded;
}
static double rounded_to(double value, int32_t type) { return type == RW_FLOAT64 ? value : as_float(value); }

/* Rays in one layout at an odd address; t, uv, normal and ids in the same layout one after another. */
static void check_layout(const layout *l, int32_t number, int32_t id) {
    const int64_t size = size_of(number);
    rw_rays rays;
    rw_hits hits;
    rw_array *array = NULL;
    int which, axis;
    int64_t i;
    unsigned char *origin = input + 1, *direction = input + 1 + (COUNT * 12 + 40) * 8;
    const unsigned char before = 0xA5;
    static unsigned char copy[sizeof input];

    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    rays.struct_size = sizeof rays;
    hits.struct_size = sizeof hits;
    rays.count = COUNT;
    for (which = 0; which < 2; ++which) {
        unsigned char *to = which == 0 ? origin : direction;
        array = which == 0 ? &rays.origin : &rays.direction;
        for (i = 0; i < COUNT; ++i) {
            for (axis = 0; axis < 3; ++axis) {
                put_number(to + place(l, size, 3, i, axis), number,
                           which == 0 ? rays_in[i].origin[axis] : rays_in[i].direction[axis]);
            }
        }
        array->data = to + l->first * size;
        array->stride = l->stride * size;
        array->component_stride = l->component_stride * size;
        array->type = number;
    }
    memcpy(copy, input, sizeof input);

    for (which = 0; which < 6; ++which) {
        static const int components[] = {1, 2, 3, 1, 1, 1};
        rw_output *outputs[6];
        rw_hits one = hits;
        const int32_t type = which < 3 ? number : id;
        const int64_t bytes = size_of(type);
        layout narrow = *l;
        outputs[0] = &one.t;
        outputs[1] = &one.uv;
        outputs[2] = &one.normal;
        outputs[3] = &one.instance;
        outputs[4] = &one.geometry;
        outputs[5] = &one.primitive;
        memset(output, before, sizeof output);
        outputs[which]->data = output + 1 + narrow.first * bytes;
        outputs[which]->stride = narrow.stride * bytes;
        outputs[which]->component_stride = narrow.component_stride * bytes;
        outputs[which]->type = type;
        if (!CHECK_OK(rw_scene_intersect_batch(scene, &rays, &one, NULL))) {
            fprintf(stderr, "    layout %s, output %d\n", l->name, which);
            return;
        }
        for (i = 0; i < COUNT; ++i) {
            for (axis = 0; axis < components[which]; ++axis) {
                unsigned char *at = output + 1 + place(&narrow, bytes, components[which], i, axis);
                int good;
                if (which < 3) {
                    const double value = which == 0   ? wanted[i].t
                                         : which == 1 ? (axis == 0 ? wanted[i].u : wanted[i].v)
                                                      : wanted_normal[i][axis];
                    good = same_number(get_number(at, type), rounded_to(value, type));
                } else {
                    const uint32_t value = which == 3   ? wanted[i].instance
                                           : which == 4 ? wanted[i].geometry
                                                        : wanted[i].primitive;
                    good = get_id(at, type) == (type == RW_UINT64 && value == RW_INVALID_ID ? UINT64_MAX : value);
                }
                if (!CHECK(good)) {
                    fprintf(stderr, "    layout %s, type %d, output %d, ray %d\n", l->name, (int)type, which, (int)i);
                    return;
                }
                memset(at, before, (size_t)bytes);
            }
        }
        /* Nothing else has been written. */
        for (i = 0; i < (int64_t)sizeof output; ++i) {
            if (output[i] != before) break;
        }
        CHECK(i == (int64_t)sizeof output);
    }
    CHECK(memcmp(copy, input, sizeof input) == 0);
}

/* One origin for all, one direction for all, limits for each or for all. */
static void repeated_elements(void) {
    double t[COUNT];
    double tmax[COUNT];
    double tmin = 0.25;
    rw_rays rays;
    rw_hits hits;
    rw_hit hit;
    int i;
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    rays.struct_size = sizeof rays;
    hits.struct_size = sizeof hits;
    rays.count = COUNT;
    rays.origin.data = rays_in[3].origin;
    rays.origin.stride = RW_REPEAT;
    rays.origin.type = RW_FLOAT64;
    rays.direction.data = rays_in[0].direction;
    rays.direction.stride = sizeof(rw_ray);
    rays.direction.type = RW_FLOAT64;
    rays.tmin.data = &tmin;
    rays.tmin.stride = RW_REPEAT;
    rays.tmin.type = RW_FLOAT64;
    rays.tmax.data = tmax;
    rays.tmax.type = RW_FLOAT64;
    hits.t.data = t;
    hits.t.type = RW_FLOAT64;
    for (i = 0; i < COUNT; ++i) tmax[i] = 0.5 + 0.01 * i;
    CHECK_OK(rw_scene_intersect_batch(scene, &rays, &hits, NULL));
    for (i = 0; i < COUNT; ++i) {
        rw_ray ray = rays_in[i];
        memcpy(ray.origin, rays_in[3].origin, sizeof ray.origin);
        ray.tmin = tmin;
        ray.tmax = tmax[i];
        CHECK_OK(rw_scene_intersect(scene, &ray, NULL, &hit));
        CHECK(same_number(hit.t, t[i]));
    }
    rays.direction.stride = RW_REPEAT;
    CHECK_OK(rw_scene_intersect_batch(scene, &rays, &hits, NULL));
    {
        rw_ray ray = rays_in[0];
        memcpy(ray.origin, rays_in[3].origin, sizeof ray.origin);
        ray.tmin = tmin;
        ray.tmax = tmax[COUNT - 1];
        CHECK_OK(rw_scene_intersect(scene, &ray, NULL, &hit));
        CHECK(same_number(hit.t, t[COUNT - 1]));
    }
}

static void flags_of_every_type(void) {
    static const int32_t types[] = {RW_TYPE_DEFAULT, RW_UINT8, RW_UINT32, RW_UINT64};
    unsigned char bytes[COUNT * 16 + 8];
    rw_rays rays;
    rw_output flags;
    int k, i, backwards;
    memset(&rays, 0, sizeof rays);
    rays.struct_size = sizeof rays;
    rays.count = COUNT;
    rays.origin.data = rays_in[0].origin;
    rays.direction.data = rays_in[0].direction;
    rays.origin.stride = rays.direction.stride = sizeof(rw_ray);
    rays.origin.type = rays.direction.type = RW_FLOAT64;
    for (k = 0; k < 4; ++k) {
        const int64_t size = types[k] == RW_TYPE_DEFAULT ? 1 : size_of(types[k]);
        for (backwards = 0; backwards < 2; ++backwards) {
            memset(bytes, 0xEE, sizeof bytes);
            memset(&flags, 0, sizeof flags);
            flags.data = bytes + 3 + (backwards ? (COUNT - 1) * 2 * size : 0);
            flags.stride = backwards ? -2 * size : 2 * size;
            flags.type = types[k];
            CHECK_OK(rw_scene_occluded_batch(scene, &rays, &flags, NULL));
            for (i = 0; i < COUNT; ++i) {
                uint64_t value = 0;
                int32_t single = -1;
                memcpy(&value, bytes + 3 + 2 * size * (backwards ? COUNT - 1 - i : i),
                       (size_t)size); /* little endian */
                CHECK_OK(rw_scene_occluded(scene, &rays_in[i], NULL, &single));
                CHECK(value == (uint64_t)single && single == (wanted[i].primitive != RW_INVALID_ID));
            }
        }
    }
}

static void all_hits(void) {
    static uint64_t offsets[COUNT + 1];
    static rw_hit single[600];
    uint64_t needed = 0, again = 0, i, k;
    double *t;
    uint32_t *primitive;
    rw_rays rays;
    rw_hits hits;
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    rays.struct_size = sizeof rays;
    hits.struct_size = sizeof hits;
    rays.count = COUNT;
    rays.origin.data = rays_in[0].origin;
    rays.direction.data = rays_in[0].direction;
    rays.origin.stride = rays.direction.stride = sizeof(rw_ray);
    rays.origin.type = rays.direction.type = RW_FLOAT64;
    CHECK_OK(rw_scene_intersect_all_batch(scene, &rays, offsets, NULL, 0, &needed, NULL));
    CHECK(offsets[0] == 0 && offsets[COUNT] == needed && needed > COUNT / 4);
    t = (double *)malloc((size_t)needed * sizeof *t);
    primitive = (uint32_t *)malloc((size_t)needed * sizeof *primitive);
    if (t == NULL || primitive == NULL) exit(1);
    hits.t.data = t;
    hits.t.type = RW_FLOAT64;
    hits.primitive.data = primitive;
    CHECK_OK(rw_scene_intersect_all_batch(scene, &rays, offsets, &hits, needed, &again, NULL));
    CHECK(again == needed);
    for (i = 0; i < COUNT; ++i) {
        uint64_t count = 0;
        CHECK(offsets[i] <= offsets[i + 1]);
        CHECK_OK(rw_scene_intersect_all(scene, &rays_in[i], NULL, single, 600, &count));
        CHECK(count == offsets[i + 1] - offsets[i]);
        if (count > 0) CHECK(memcmp(&single[0], &wanted[i], sizeof single[0]) == 0);
        for (k = 0; k < count && count == offsets[i + 1] - offsets[i]; ++k) {
            CHECK(same_number(t[offsets[i] + k], single[k].t) && primitive[offsets[i] + k] == single[k].primitive);
            CHECK(k == 0 || single[k - 1].t < single[k].t ||
                  (single[k - 1].t == single[k].t && single[k - 1].primitive < single[k].primitive));
        }
    }
    CHECK_ERROR(rw_scene_intersect_all_batch(scene, &rays, offsets, &hits, needed - 1, NULL, NULL), RW_ERROR_CAPACITY,
                "hits");
    CHECK(offsets[COUNT] == needed);
    free(t);
    free(primitive);
}

static void invalid_rays(void) {
    rw_ray bad[8];
    rw_rays rays;
    rw_hits hits;
    rw_query_options options;
    uint64_t invalid = 99;
    double t[8];
    float normal[8][3];
    uint32_t id[8];
    rw_scene_statistics before, after;
    rw_hit hit;
    int i;
    for (i = 0; i < 8; ++i) bad[i] = rays_in[i];
    bad[0].origin[1] = NAN;
    bad[1].direction[2] = NAN;
    bad[2].direction[0] = bad[2].direction[1] = bad[2].direction[2] = 0.0;
    bad[3].origin[0] = INFINITY;
    bad[3].origin[1] = -INFINITY;
    bad[4].direction[0] = -INFINITY;
    bad[5].direction[0] = 0;
    bad[6].tmin = 2.0;
    bad[6].tmax = 1.0;
    bad[7].tmax = NAN;
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    memset(&options, 0, sizeof options);
    rays.struct_size = sizeof rays;
    hits.struct_size = sizeof hits;
    options.struct_size = sizeof options;
    options.invalid_rays = &invalid;
    before.struct_size = after.struct_size = sizeof before;
    rays.count = 8;
    rays.origin.data = bad[0].origin;
    rays.direction.data = bad[0].direction;
    rays.tmin.data = &bad[0].tmin;
    rays.tmax.data = &bad[0].tmax;
    rays.origin.stride = rays.direction.stride = rays.tmin.stride = rays.tmax.stride = sizeof(rw_ray);
    rays.origin.type = rays.direction.type = rays.tmin.type = rays.tmax.type = RW_FLOAT64;
    hits.t.data = t;
    hits.t.type = RW_FLOAT64;
    hits.primitive.data = id;
    hits.normal.data = normal;
    CHECK_OK(rw_scene_get_statistics(scene, &before));
    CHECK_OK(rw_scene_intersect_batch(scene, &rays, &hits, &options));
    CHECK_OK(rw_scene_get_statistics(scene, &after));
    CHECK(invalid == 3);
    CHECK(after.rays == before.rays + 8 && after.invalid_rays == before.invalid_rays + 3 &&
          after.rays_ns >= before.rays_ns);
    for (i = 0; i < 8; ++i) {
        int32_t occluded = 5;
        CHECK_OK(rw_scene_intersect(scene, &bad[i], NULL, &hit));
        CHECK(same_number(hit.t, t[i]) && hit.primitive == id[i]);
        CHECK_OK(rw_scene_occluded(scene, &bad[i], NULL, &occluded));
        if (i == 5) continue;
        CHECK(hit.t == INFINITY && hit.u == 0 && hit.v == 0);
        CHECK(normal[i][0] == 0 && normal[i][1] == 0 && normal[i][2] == 0);
        CHECK(hit.instance == RW_INVALID_ID && hit.geometry == RW_INVALID_ID && hit.primitive == RW_INVALID_ID &&
              hit.reserved == 0);
        CHECK(occluded == 0);
    }
    CHECK_OK(rw_scene_get_statistics(scene, &after));
    CHECK(after.invalid_rays == before.invalid_rays + 3 + 6); /* single calls count as well, any hit too */
}

int main(void) {
    soup s = make_soup(400);
    size_t l;
    int i, misses = 0;
    use_all_helpers();
    scene = make_scene(&s, NULL);
    for (i = 0; i < COUNT; ++i) {
        int axis;
        rays_in[i] = random_ray();
        for (axis = 0; axis < 3; ++axis) { /* so that float32 rays are the same */
            rays_in[i].origin[axis] = as_float(rays_in[i].origin[axis]);
            rays_in[i].direction[axis] = as_float(rays_in[i].direction[axis]);
        }
        CHECK_OK(rw_scene_intersect(scene, &rays_in[i], NULL, &wanted[i]));
        if (wanted[i].primitive != RW_INVALID_ID) CHECK_OK(rw_scene_normal(scene, &wanted[i], wanted_normal[i]));
        misses += wanted[i].primitive == RW_INVALID_ID;
    }
    CHECK(misses > 0 && misses < COUNT - 50);
    for (l = 0; l < sizeof layouts / sizeof layouts[0]; ++l) {
        check_layout(&layouts[l], RW_FLOAT32, RW_UINT32);
        check_layout(&layouts[l], RW_FLOAT64, RW_UINT64);
        check_layout(&layouts[l], RW_FLOAT64, RW_UINT32);
    }
    repeated_elements();
    flags_of_every_type();
    all_hits();
    invalid_rays();
    rw_scene_release(scene);
    free_soup(&s);
    return finish("batches");
}
