/* Skip lists: from every structure and entry point, the answers of a scene without the triangles that are skipped. */
#include "testing.h"

#define TRIANGLES 60 /* in each of two meshes */
#define RAYS 80
#define MOST 12 /* skipped by one ray */
#define ROOM (2 * TRIANGLES)

static rw_ray rays[RAYS];
static rw_primitive_id skipped[RAYS][MOST];
static uint32_t skip_count[RAYS];

static rw_primitive_id id_of(const rw_hit *hit) {
    rw_primitive_id id;
    id.instance = hit->instance;
    id.geometry = hit->geometry;
    id.primitive = hit->primitive;
    return id;
}

static int is_skipped(uint32_t ray, const rw_hit *hit) {
    uint32_t k;
    for (k = 0; k < skip_count[ray]; ++k) {
        if (skipped[ray][k].geometry == hit->geometry && skipped[ray][k].primitive == hit->primitive) return 1;
    }
    return 0;
}

static rw_scene *two_meshes(const soup *s, const char *structure) {
    rw_scene *scene = NULL;
    const rw_triangles t = triangles_of(s);
    NEED_OK(rw_scene_create(NULL, &scene));
    NEED_OK(rw_scene_add_triangles(scene, &t, NULL));
    NEED_OK(rw_scene_add_triangles(scene, &t, NULL)); /* the same again: every hit is a tie of two */
    NEED_OK(rw_scene_set_structure(scene, structure));
    NEED_OK(rw_scene_commit(scene, NULL));
    return scene;
}

/* Rays, and for each some of the triangles it hits, in no order, one of them twice, with entries that stand for nothing. */
static void make_cases(const rw_scene *scene) {
    uint32_t i, k;
    for (i = 0; i < RAYS; ++i) {
        rw_hit hits[ROOM];
        uint64_t needed = 0;
        rays[i] = random_ray();
        NEED_OK(rw_scene_intersect_all(scene, &rays[i], NULL, hits, ROOM, &needed));
        skip_count[i] = i % MOST;
        for (k = 0; k < skip_count[i]; ++k) {
            rw_primitive_id *id = &skipped[i][k];
            if (k % 4 == 3 || needed == 0) {
                id->instance = id->geometry = id->primitive = RW_INVALID_ID;
            } else {
                *id = id_of(&hits[(7u * k + i) % needed]);
            }
        }
        if (skip_count[i] > 3) skipped[i][2] = skipped[i][0];
    }
}

static rw_array array_of(const void *data, int32_t type, int64_t stride) {
    rw_array array;
    memset(&array, 0, sizeof array);
    array.data = data;
    array.type = type;
    array.stride = stride;
    return array;
}

static rw_rays describe_rays(void) {
    rw_rays all;
    memset(&all, 0, sizeof all);
    all.struct_size = sizeof all;
    all.count = RAYS;
    all.origin = array_of(rays[0].origin, RW_FLOAT64, sizeof rays[0]);
    all.direction = array_of(rays[0].direction, RW_FLOAT64, sizeof rays[0]);
    all.tmin = array_of(&rays[0].tmin, RW_FLOAT64, sizeof rays[0]);
    all.tmax = array_of(&rays[0].tmax, RW_FLOAT64, sizeof rays[0]);
    return all;
}

typedef struct columns {
    double t[RAYS * ROOM];
    uint64_t geometry[RAYS * ROOM];
    uint32_t primitive[RAYS * ROOM];
} columns;

static rw_hits describe_columns(columns *c) {
    rw_hits hits;
    memset(&hits, 0, sizeof hits);
    hits.struct_size = sizeof hits;
    hits.t.data = c->t;
    hits.t.type = RW_FLOAT64;
    hits.geometry.data = c->geometry;
    hits.geometry.type = RW_UINT64;
    hits.primitive.data = c->primitive;
    return hits;
}

static int same_as(const columns *c, uint64_t at, const rw_hit *hit) {
    const uint64_t geometry = hit->geometry == RW_INVALID_ID ? ~(uint64_t)0 : hit->geometry;
    return memcmp(&c->t[at], &hit->t, sizeof hit->t) == 0 && c->geometry[at] == geometry &&
           c->primitive[at] == hit->primitive;
}

static rw_hit wanted_closest[RAYS];
static rw_hit wanted_all[RAYS][ROOM];
static uint64_t wanted_count[RAYS];

/* What is left of all hits: no ray here meets an edge, so leaving hits out is all that skipping does. */
static void find_wanted(const rw_scene *scene) {
    uint32_t i;
    for (i = 0; i < RAYS; ++i) {
        rw_hit hits[ROOM];
        uint64_t needed = 0, k;
        const rw_hit miss = {INFINITY, 0, 0, RW_INVALID_ID, RW_INVALID_ID, RW_INVALID_ID, 0};
        NEED_OK(rw_scene_intersect_all(scene, &rays[i], NULL, hits, ROOM, &needed));
        wanted_count[i] = 0;
        for (k = 0; k < needed; ++k) {
            if (!is_skipped(i, &hits[k])) wanted_all[i][wanted_count[i]++] = hits[k];
        }
        wanted_closest[i] = wanted_count[i] > 0 ? wanted_all[i][0] : miss;
    }
}

static void check_single(const rw_scene *scene, const rw_scene *view) {
    uint32_t i;
    for (i = 0; i < RAYS; ++i) {
        rw_ray_options options;
        rw_hit hit, hits[ROOM];
        int32_t occluded = -1;
        uint64_t needed = 0;
        options.struct_size = sizeof options;
        options.skip_count = skip_count[i];
        options.skip = skip_count[i] > 0 ? skipped[i] : NULL;
        memset(&hit, 1, sizeof hit);
        if (view == NULL) {
            CHECK_OK(rw_scene_intersect(scene, &rays[i], &options, &hit));
            CHECK_OK(rw_scene_occluded(scene, &rays[i], &options, &occluded));
            CHECK_OK(rw_scene_intersect_all(scene, &rays[i], &options, hits, ROOM, &needed));
        } else {
            CHECK_OK(rw_scene_intersect(view, &rays[i], &options, &hit));
            CHECK_OK(rw_scene_occluded(view, &rays[i], &options, &occluded));
            CHECK_OK(rw_scene_intersect_all(view, &rays[i], &options, hits, ROOM, &needed));
        }
        CHECK(memcmp(&hit, &wanted_closest[i], sizeof hit) == 0);
        CHECK(occluded == (wanted_count[i] > 0));
        CHECK(needed == wanted_count[i] && memcmp(hits, wanted_all[i], (size_t)needed * sizeof hits[0]) == 0);
    }
}

/* With offsets, and ids of either type. */
static void check_batches(const rw_scene *scene, const rw_scene *view, const soup *s) {
    static uint64_t offsets[RAYS + 1], found[RAYS + 1];
    static uint32_t geometry[RAYS * MOST];
    static uint64_t primitive[RAYS * MOST];
    static columns out;
    rw_rays in = describe_rays();
    rw_hits hits = describe_columns(&out);
    rw_output flags;
    static uint8_t occluded[RAYS];
    uint64_t entries = 5, k, needed = 0; /* the lists need not begin at the first entry */
    uint32_t i, threads;
    memset(&flags, 0, sizeof flags);
    flags.data = occluded;
    for (i = 0; i < RAYS; ++i) {
        offsets[i] = entries;
        for (k = 0; k < skip_count[i]; ++k, ++entries) {
            geometry[entries] = skipped[i][k].geometry;
            primitive[entries] =
                skipped[i][k].primitive == RW_INVALID_ID && k % 2 == 1 ? ~(uint64_t)0 : skipped[i][k].primitive;
        }
    }
    offsets[RAYS] = entries;
    in.skip_offsets = offsets;
    in.skip_geometry = array_of(geometry, RW_UINT32, 0);
    in.skip_primitive = array_of(primitive, RW_UINT64, 0);
    for (threads = 1; threads < 4; ++threads) {
        rw_query_options query;
        memset(&query, 0, sizeof query);
        query.struct_size = sizeof query;
        query.threads = threads;
        if (view == NULL) {
            CHECK_OK(rw_scene_intersect_batch(scene, &in, &hits, &query));
            CHECK_OK(rw_scene_occluded_batch(scene, &in, &flags, &query));
        } else {
            CHECK_OK(rw_scene_intersect_batch(view, &in, &hits, &query));
            CHECK_OK(rw_scene_occluded_batch(view, &in, &flags, &query));
        }
        for (i = 0; i < RAYS; ++i) {
            CHECK(same_as(&out, i, &wanted_closest[i]));
            CHECK(occluded[i] == (wanted_count[i] > 0));
        }
        if (view == NULL) {
            CHECK_OK(rw_scene_intersect_all_batch(scene, &in, found, &hits, RAYS * ROOM, &needed, &query));
        } else {
            CHECK_OK(rw_scene_intersect_all_batch(view, &in, found, &hits, RAYS * ROOM, &needed, &query));
        }
        for (i = 0; i < RAYS; ++i) {
            if (!CHECK(found[i + 1] - found[i] == wanted_count[i])) continue;
            for (k = 0; k < wanted_count[i]; ++k) CHECK(same_as(&out, found[i] + k, &wanted_all[i][k]));
        }
    }
    if (view == NULL) {
        rw_triangles meshes[2];
        meshes[0] = meshes[1] = triangles_of(s);
        CHECK_OK(rw_once_intersect(meshes, 2, &in, &hits, NULL));
        for (i = 0; i < RAYS; ++i) CHECK(same_as(&out, i, &wanted_closest[i]));
    }
}

/* The outputs of one batch are the skips of the next: the second of all hits. */
static void check_relaunch(const rw_scene *scene) {
    static columns first, second;
    rw_rays in = describe_rays();
    const rw_hits first_hits = describe_columns(&first);
    const rw_hits second_hits = describe_columns(&second);
    uint32_t i;
    CHECK_OK(rw_scene_intersect_batch(scene, &in, &first_hits, NULL));
    in.skip_geometry = array_of(first.geometry, RW_UINT64, 0);
    in.skip_primitive = array_of(first.primitive, RW_UINT32, 0);
    CHECK_OK(rw_scene_intersect_batch(scene, &in, &second_hits, NULL));
    for (i = 0; i < RAYS; ++i) {
        rw_hit all[ROOM];
        uint64_t needed = 0;
        CHECK_OK(rw_scene_intersect_all(scene, &rays[i], NULL, all, ROOM, &needed));
        CHECK(needed < 2 ? second.primitive[i] == RW_INVALID_ID : same_as(&second, i, &all[1]));
    }
}

static void check_mistakes(const rw_scene *scene) {
    rw_rays in = describe_rays();
    static columns out;
    const rw_hits hits = describe_columns(&out);
    uint64_t offsets[RAYS + 1], primitives[RAYS];
    uint32_t geometries[RAYS], i;
    rw_ray_options options;
    rw_primitive_id ids[3];
    rw_hit hit;
    int32_t occluded = 77;
    memset(&hit, 7, sizeof hit);
    memset(ids, 0, sizeof ids);
    for (i = 0; i < 3; ++i) ids[i].instance = RW_INVALID_ID;
    options.struct_size = sizeof options;
    options.skip_count = 3;
    options.skip = NULL;
    CHECK_ERROR(rw_scene_intersect(scene, &rays[0], &options, &hit), RW_ERROR_INVALID_ARGUMENT, "options.skip|NULL");
    options.skip = ids;
    ids[2].geometry = 2;
    CHECK_ERROR(rw_scene_intersect(scene, &rays[0], &options, &hit), RW_ERROR_INDEX_OUT_OF_RANGE,
                "options.skip[2]|geometry 2|has 2");
    ids[2].geometry = 1;
    ids[2].primitive = TRIANGLES;
    CHECK_ERROR(rw_scene_occluded(scene, &rays[0], &options, &occluded), RW_ERROR_INDEX_OUT_OF_RANGE,
                "options.skip[2]|primitive 60|geometry 1 has 60 triangles");
    ids[2].primitive = 0;
    ids[1].instance = 0;
    CHECK_ERROR(rw_scene_occluded(scene, &rays[0], &options, &occluded), RW_ERROR_INDEX_OUT_OF_RANGE,
                "options.skip[1]|instance 0|no instances");
    options.struct_size = 3;
    CHECK_ERROR(rw_scene_occluded(scene, &rays[0], &options, &occluded), RW_ERROR_INVALID_ARGUMENT,
                "options: struct_size is 3");
    CHECK_ERROR(rw_scene_intersect(scene, &rays[0], NULL, NULL), RW_ERROR_INVALID_ARGUMENT, "hit|NULL");
    CHECK_ERROR(rw_scene_intersect_all(scene, NULL, NULL, NULL, 0, NULL), RW_ERROR_INVALID_ARGUMENT, "ray|NULL");
    CHECK(occluded == 77 && hit.primitive == 0x07070707u);

    for (i = 0; i < RAYS; ++i) {
        primitives[i] = RW_INVALID_ID;
        geometries[i] = 1;
        offsets[i] = i;
    }
    offsets[RAYS] = RAYS;
    in.skip_offsets = offsets;
    CHECK_ERROR(rw_scene_intersect_batch(scene, &in, &hits, NULL), RW_ERROR_INVALID_ARGUMENT,
                "rays.skip_primitive|data is NULL");
    in.skip_primitive = array_of(primitives, RW_UINT64, 0);
    in.skip_geometry = array_of(geometries, 0, 0);
    out.t[0] = -5.0;
    primitives[17] = 9000;
    CHECK_ERROR(rw_scene_intersect_batch(scene, &in, &hits, NULL), RW_ERROR_INDEX_OUT_OF_RANGE,
                "rays.skip_primitive[17]|primitive 9000|geometry 1 has 60");
    primitives[17] = 0;
    geometries[17] = 5;
    CHECK_ERROR(rw_scene_intersect_batch(scene, &in, &hits, NULL), RW_ERROR_INDEX_OUT_OF_RANGE,
                "rays.skip_primitive[17]|geometry 5");
    geometries[17] = 0;
    offsets[30] = 12;
    CHECK_ERROR(rw_scene_intersect_batch(scene, &in, &hits, NULL), RW_ERROR_INVALID_ARGUMENT,
                "rays.skip_offsets[30]|12|29");
    in.skip_primitive.type = RW_FLOAT32;
    CHECK_ERROR(rw_scene_intersect_batch(scene, &in, &hits, NULL), RW_ERROR_INVALID_ARGUMENT,
                "rays.skip_primitive|type");
    CHECK(out.t[0] == -5.0);
}

int main(void) {
    soup s = make_soup(TRIANGLES);
    uint32_t structures = 0, i;
    rw_scene *scan = two_meshes(&s, "linear_scan");
    use_all_helpers();
    make_cases(scan);
    find_wanted(scan);
    check_mistakes(scan);
    NEED_OK(rw_structure_count(&structures));
    for (i = 0; i < structures; ++i) {
        rw_scene *view = NULL;
        rw_view_options options;
        const char *name = NULL;
        rw_scene *scene;
        NEED_OK(rw_structure_name(i, &name));
        scene = two_meshes(&s, name);
        memset(&options, 0, sizeof options);
        options.struct_size = sizeof options;
        options.count = RAYS;
        options.structure = name;
        memcpy(options.origin, rays[3].origin, sizeof options.origin);
        NEED_OK(rw_scene_view(scene, &options, NULL, &view));
        check_single(scene, NULL);
        check_single(scene, view);
        check_batches(scene, NULL, &s);
        check_batches(scene, view, &s);
        check_relaunch(scene);
        rw_scene_release(view);
        rw_scene_release(scene);
    }
    rw_scene_release(scan);
    free_soup(&s);
    return finish("skip lists");
}
