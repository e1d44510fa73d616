/* Batches whose rays or outputs cannot be, and outputs that are too small. The status the header promises, and a message that
 * names argument and element. */
#include "errors_testing.h"

static void batches(void) {
    double origins[12] = {0}, directions[12] = {0}, out[64];
    uint32_t ids[16];
    uint64_t offsets[5], needed = 77;
    rw_rays rays;
    rw_hits hits;
    rw_output flags;
    rw_query_options options;
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    memset(&flags, 0, sizeof flags);
    memset(&options, 0, sizeof options);
    rays.struct_size = sizeof rays;
    hits.struct_size = sizeof hits;
    rays.count = 4;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT, "rays.origin|NULL");
    rays.origin.data = origins;
    rays.origin.type = RW_FLOAT64;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT,
                "rays.direction|NULL");
    rays.direction.data = directions;
    rays.direction.type = RW_UINT64;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT,
                "rays.direction|type 5");
    rays.direction.type = RW_FLOAT64;
    rays.tmin.data = origins;
    rays.tmin.type = RW_UINT8;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT, "rays.tmin|type 3");
    rays.tmin.data = NULL;
    rays.flags = 1;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT, "rays.flags|1");
    rays.flags = 0;
    hits.flags = 2;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT, "hits.flags|2");
    hits.flags = 0;
    hits.t.data = out;
    hits.t.type = RW_UINT32;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT, "hits.t|type 4");
    hits.t.type = RW_FLOAT64;
    hits.primitive.data = ids;
    hits.primitive.type = RW_FLOAT32;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT,
                "hits.primitive|type 1");
    hits.primitive.type = 0;
    hits.t.stride = RW_REPEAT;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_OVERLAP, "hits.t|RW_REPEAT");
    hits.t.stride = 4;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_OVERLAP, "hits.t|overlap");
    hits.t.stride = -7;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_OVERLAP, "hits.t|overlap");
    hits.t.stride = 0;
    hits.normal.data = out;
    hits.normal.type = RW_FLOAT64;
    hits.normal.component_stride = 4;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_OVERLAP, "hits.normal|overlap");
    hits.normal.component_stride = 8;
    hits.normal.stride = 8; /* y of one ray is x of the next */
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_OVERLAP, "hits.normal|overlap");
    hits.normal.stride = -16;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_OVERLAP, "hits.normal|overlap");
    hits.normal.data = NULL;
    rays.count = 1;
    hits.t.stride = RW_REPEAT;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_OVERLAP, "hits.t|RW_REPEAT");
    hits.t.stride = 0;
    rays.count = 4;
    CHECK_ERROR(rw_scene_occluded_batch(committed, &rays, &flags, NULL), RW_ERROR_INVALID_ARGUMENT, "occluded|NULL");
    flags.data = ids;
    flags.type = RW_FLOAT32;
    CHECK_ERROR(rw_scene_occluded_batch(committed, &rays, &flags, NULL), RW_ERROR_INVALID_ARGUMENT, "occluded|type 1");
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, &options), RW_ERROR_INVALID_ARGUMENT,
                "options|struct_size");
    rays.count = RW_RAYS_LIMIT + 1;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_TOO_MANY, "rays.count");
    rays.count = 0;
    CHECK_OK(rw_scene_intersect_batch(committed, &rays, &hits, NULL));
    CHECK_OK(rw_scene_intersect_all_batch(committed, &rays, offsets, NULL, 0, &needed, NULL));
    CHECK(needed == 0 && offsets[0] == 0);
}

static void capacity(void) {
    soup many = make_soup(3000);
    rw_scene *dense = make_scene(&many, "linear_scan");
    rw_ray ray = {{-2, 0.01, 0.02}, 0, {1, 0, 0}, 0};
    rw_hit hits[200], fewer[2];
    uint64_t needed = 0, offsets[2];
    char text[16];
    rw_rays rays;
    rw_hits out;
    float t[2] = {-1, -1};
    ray.tmax = INFINITY;
    CHECK_OK(rw_scene_intersect_all(dense, &ray, NULL, NULL, 0, &needed));
    CHECK(needed > 2 && needed < 200);
    CHECK_OK(rw_scene_intersect_all(dense, &ray, NULL, hits, 200, &needed));
    CHECK_ERROR(rw_scene_intersect_all(dense, &ray, NULL, fewer, 2, &needed), RW_ERROR_CAPACITY, "hits|capacity is 2");
    CHECK(memcmp(hits, fewer, sizeof fewer) == 0);

    memset(&rays, 0, sizeof rays);
    memset(&out, 0, sizeof out);
    rays.struct_size = sizeof rays;
    rays.count = 1;
    rays.origin.data = ray.origin;
    rays.origin.type = RW_FLOAT64;
    rays.direction = rays.origin;
    rays.direction.data = ray.direction;
    out.struct_size = sizeof out;
    out.t.data = t;
    CHECK_ERROR(rw_scene_intersect_all_batch(dense, &rays, offsets, &out, 2, &needed, NULL), RW_ERROR_CAPACITY,
                "hits|capacity is 2");
    CHECK(needed > 2 && offsets[0] == 0 && offsets[1] == needed && t[0] == -1 && t[1] == -1);

    memset(text, 'x', sizeof text);
    CHECK_ERROR(rw_scene_explain(committed, RW_FORMAT_TEXT, text, sizeof text, &needed), RW_ERROR_CAPACITY,
                "buffer|capacity is 16");
    CHECK(text[15] == '\0' && strlen(text) == 15 && needed > 16);
    CHECK_ERROR(rw_profile_text(profile, RW_FORMAT_JSON, text, 1, &needed), RW_ERROR_CAPACITY, "buffer");
    CHECK(text[0] == '\0');
    rw_scene_release(dense);
    free_soup(&many);
}

int main(void) {
    set_up();
    batches();
    capacity();
    return tear_down("errors of queries");
}
