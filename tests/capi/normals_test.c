/* Normals, asked for one hit at a time: they are those of batches, and hits that are none are refused. */
#include "testing.h"

#define RAYS 300

static rw_scene *scene;
static soup s;

static void are_geometric(void) {
    int i, hits = 0;
    for (i = 0; i < RAYS; ++i) {
        const rw_ray ray = random_ray();
        rw_hit hit;
        double normal[3], edge[2][3], length = 0.0, along[2] = {0.0, 0.0}, turn = 0.0;
        int axis;
        const float *v;
        CHECK_OK(rw_scene_intersect(scene, &ray, NULL, &hit));
        if (hit.primitive == RW_INVALID_ID) continue;
        ++hits;
        CHECK_OK(rw_scene_normal(scene, &hit, normal));
        v = s.vertices + 9 * hit.primitive;
        for (axis = 0; axis < 3; ++axis) {
            edge[0][axis] = (double)v[3 + axis] - (double)v[axis];
            edge[1][axis] = (double)v[6 + axis] - (double)v[axis];
            length += normal[axis] * normal[axis];
            along[0] += normal[axis] * edge[0][axis];
            along[1] += normal[axis] * edge[1][axis];
        }
        for (axis = 0; axis < 3; ++axis) {
            const int y = (axis + 1) % 3, z = (axis + 2) % 3;
            turn += normal[axis] * (edge[0][y] * edge[1][z] - edge[0][z] * edge[1][y]);
        }
        CHECK(fabs(length - 1.0) < 1e-14 && fabs(along[0]) < 1e-15 && fabs(along[1]) < 1e-15 && turn > 0.0);
    }
    CHECK(hits > RAYS / 10);
}

/* Of closest hits and of all hits, in both precisions. */
static void are_those_of_batches(void) {
    rw_ray in[RAYS];
    double normal[RAYS][3];
    float narrow[RAYS][3];
    uint32_t primitive[RAYS];
    rw_rays rays;
    rw_hits hits;
    int i;
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    rays.struct_size = sizeof rays;
    hits.struct_size = sizeof hits;
    for (i = 0; i < RAYS; ++i) in[i] = random_ray();
    rays.count = RAYS;
    rays.origin.data = in[0].origin;
    rays.direction.data = in[0].direction;
    rays.origin.stride = rays.direction.stride = sizeof(rw_ray);
    rays.origin.type = rays.direction.type = RW_FLOAT64;
    hits.primitive.data = primitive;
    hits.normal.data = normal;
    hits.normal.type = RW_FLOAT64;
    CHECK_OK(rw_scene_intersect_batch(scene, &rays, &hits, NULL));
    hits.normal.data = narrow;
    hits.normal.type = RW_FLOAT32;
    CHECK_OK(rw_scene_intersect_batch(scene, &rays, &hits, NULL));
    for (i = 0; i < RAYS; ++i) {
        rw_hit hit;
        rw_hit_f32 hit32;
        double wanted[3] = {0.0, 0.0, 0.0};
        float wanted32[3] = {0.0f, 0.0f, 0.0f};
        int axis;
        memset(&hit, 0, sizeof hit);
        memset(&hit32, 0, sizeof hit32);
        hit.instance = hit32.instance = RW_INVALID_ID;
        hit.primitive = hit32.primitive = primitive[i];
        if (primitive[i] != RW_INVALID_ID) {
            CHECK_OK(rw_scene_normal(scene, &hit, wanted));
            CHECK_OK(rw_scene_normal_f32(scene, &hit32, wanted32));
        }
        CHECK(memcmp(wanted, normal[i], sizeof wanted) == 0 && memcmp(wanted32, narrow[i], sizeof wanted32) == 0);
        for (axis = 0; axis < 3; ++axis) CHECK(wanted32[axis] == (float)wanted[axis]);
    }
}

static rw_hit hit_of(uint32_t instance, uint32_t geometry, uint32_t primitive) {
    rw_hit hit;
    memset(&hit, 0, sizeof hit);
    hit.instance = instance;
    hit.geometry = geometry;
    hit.primitive = primitive;
    return hit;
}

static void refused(const rw_scene *of, rw_hit hit, int32_t status, const char *parts) {
    double normal[3] = {5.0, 6.0, 7.0};
    float narrow[3] = {5.0f, 6.0f, 7.0f};
    rw_hit_f32 hit32;
    memset(&hit32, 0, sizeof hit32);
    hit32.instance = hit.instance;
    hit32.geometry = hit.geometry;
    hit32.primitive = hit.primitive;
    CHECK_ERROR(rw_scene_normal(of, &hit, normal), status, parts);
    CHECK_ERROR(rw_scene_normal_f32(of, &hit32, narrow), status, parts);
    CHECK(normal[0] == 5.0 && normal[1] == 6.0 && normal[2] == 7.0);
    CHECK(narrow[0] == 5.0f && narrow[1] == 6.0f && narrow[2] == 7.0f);
}

static void hits_that_are_none(void) {
    /* A triangle, one without area, one with a NaN, and one of a corner that is not there. */
    static const float vertices[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, NAN, 0, 0};
    static const uint32_t indices[12] = {0, 1, 2, 0, 1, 1, 0, 1, 3, 0, 1, 9};
    const uint32_t none = RW_INVALID_ID;
    rw_scene *odd = NULL, *empty = NULL;
    rw_triangles t;
    double normal[3];
    rw_hit hit = hit_of(none, 0, 0);
    memset(&t, 0, sizeof t);
    t.struct_size = sizeof t;
    t.flags = RW_TRIANGLES_SKIP_INVALID;
    t.vertex_count = 4;
    t.vertices.data = vertices;
    t.triangle_count = 4;
    t.indices.data = indices;
    NEED_OK(rw_scene_create(NULL, &odd));
    NEED_OK(rw_scene_add_triangles(odd, &t, NULL));
    refused(odd, hit, RW_ERROR_NOT_COMMITTED, "commit");
    NEED_OK(rw_scene_commit(odd, NULL));
    CHECK_OK(rw_scene_normal(odd, &hit, normal));
    CHECK(normal[0] == 0.0 && normal[1] == 0.0 && normal[2] == 1.0);
    refused(odd, hit_of(none, none, none), RW_ERROR_INVALID_ARGUMENT, "hit|miss");
    refused(odd, hit_of(none, 0, 1), RW_ERROR_INVALID_ARGUMENT, "hit|primitive 1|no area");
    refused(odd, hit_of(none, 0, 2), RW_ERROR_INVALID_ARGUMENT, "hit|primitive 2|not valid");
    refused(odd, hit_of(none, 0, 3), RW_ERROR_INVALID_ARGUMENT, "hit|primitive 3|not valid");
    refused(odd, hit_of(none, 0, 4), RW_ERROR_INDEX_OUT_OF_RANGE, "hit|primitive 4");
    refused(odd, hit_of(none, 1, 0), RW_ERROR_INDEX_OUT_OF_RANGE, "hit|geometry 1");
    refused(odd, hit_of(none, none, 0), RW_ERROR_INDEX_OUT_OF_RANGE, "hit|geometry");
    refused(odd, hit_of(0, 0, 0), RW_ERROR_INDEX_OUT_OF_RANGE, "hit|instance 0");
    NEED_OK(rw_scene_create(NULL, &empty));
    NEED_OK(rw_scene_commit(empty, NULL));
    refused(empty, hit, RW_ERROR_INDEX_OUT_OF_RANGE, "hit|geometry 0");
    rw_scene_release(odd);
    rw_scene_release(empty);
}

int main(void) {
    use_all_helpers();
    s = make_soup(400);
    scene = make_scene(&s, NULL);
    are_geometric();
    are_those_of_batches();
    hits_that_are_none();
    rw_scene_release(scene);
    free_soup(&s);
    return finish("normals");
}
