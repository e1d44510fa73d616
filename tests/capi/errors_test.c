/* Every way to misuse the library: the status the header promises, and a message that names argument and element. */
#include "testing.h"

#include <sys/stat.h>
#include <unistd.h>

static soup s;
static rw_scene *fresh;     /* filled, not committed */
static rw_scene *committed; /* on the linear scan */
static rw_view *view;
static rw_profile *profile;
static rw_mesh *mesh;
static char folder[] = "/tmp/raywise-errors-XXXXXX";

static const char *file_with(const char *name, const char *content) {
    static char path[512];
    FILE *file;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    remove(path);
    file = fopen(path, "wb");
    if (file == NULL || fputs(content, file) == EOF || fclose(file) != 0) exit(1);
    return path;
}

static void handles_and_pointers(void) {
    rw_hit hit;
    rw_ray ray = random_ray();
    int32_t occluded;
    uint32_t number;
    uint64_t needed, offsets[2];
    double lower[3], upper[3];
    const char *name;
    const uint32_t *faces;
    rw_triangles t = triangles_of(&s);
    rw_rays rays;
    rw_hits hits;
    rw_output flags;
    uint8_t flag = 7;
    rw_scene_statistics statistics;
    rw_grid_statistics grid;
    rw_candidate candidate;
    rw_profile_info info;
    rw_expected_rays expected;
    rw_view_options options;
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    memset(&flags, 0, sizeof flags);
    memset(&expected, 0, sizeof expected);
    memset(&options, 0, sizeof options);
    rays.struct_size = sizeof rays;
    hits.struct_size = sizeof hits;
    flags.data = &flag;
    expected.struct_size = sizeof expected;
    expected.count = 1;
    statistics.struct_size = sizeof statistics;
    grid.struct_size = sizeof grid;
    candidate.struct_size = sizeof candidate;
    info.struct_size = sizeof info;
    options.struct_size = sizeof options;
    options.count = 1;

#define NULL_HANDLE(call, name) CHECK_ERROR(call, RW_ERROR_INVALID_ARGUMENT, name "|NULL")
    NULL_HANDLE(rw_profile_load(NULL, NULL), "profile");
    NULL_HANDLE(rw_profile_retain(NULL), "profile");
    NULL_HANDLE(rw_profile_inspect(NULL, &info), "profile");
    NULL_HANDLE(rw_profile_inspect(profile, NULL), "info");
    NULL_HANDLE(rw_profile_text(NULL, 0, NULL, 0, &needed), "profile");
    NULL_HANDLE(rw_profile_text(profile, 0, NULL, 5, &needed), "buffer");
    NULL_HANDLE(rw_mesh_load(NULL, &mesh), "path");
    NULL_HANDLE(rw_mesh_load("x.obj", NULL), "mesh");
    NULL_HANDLE(rw_mesh_retain(NULL), "mesh");
    NULL_HANDLE(rw_mesh_triangles(NULL, &t), "mesh");
    NULL_HANDLE(rw_mesh_triangles(mesh, NULL), "triangles");
    NULL_HANDLE(rw_mesh_faces(NULL, &faces, &needed), "mesh");
    NULL_HANDLE(rw_mesh_faces(mesh, NULL, &needed), "face_of_triangle");
    NULL_HANDLE(rw_structure_count(NULL), "count");
    NULL_HANDLE(rw_structure_name(0, NULL), "name");
    NULL_HANDLE(rw_scene_create(NULL, NULL), "scene");
    NULL_HANDLE(rw_scene_retain(NULL), "scene");
    NULL_HANDLE(rw_scene_add_triangles(NULL, &t, NULL), "scene");
    NULL_HANDLE(rw_scene_add_triangles(fresh, NULL, NULL), "triangles");
    NULL_HANDLE(rw_scene_set_expected_rays(NULL, &expected), "scene");
    NULL_HANDLE(rw_scene_set_expected_rays(fresh, NULL), "expected");
    NULL_HANDLE(rw_scene_set_memory_limit(NULL, 0), "scene");
    NULL_HANDLE(rw_scene_set_structure(NULL, "bvh"), "scene");
    NULL_HANDLE(rw_scene_set_effort(NULL, 0, 0, 0), "scene");
    NULL_HANDLE(rw_scene_commit(NULL, NULL), "scene");
    NULL_HANDLE(rw_scene_bounds(NULL, lower, upper), "scene");
    NULL_HANDLE(rw_scene_bounds(committed, NULL, upper), "lower");
    NULL_HANDLE(rw_scene_bounds(committed, lower, NULL), "upper");
    NULL_HANDLE(rw_scene_get_statistics(NULL, &statistics), "scene");
    NULL_HANDLE(rw_scene_get_statistics(committed, NULL), "statistics");
    NULL_HANDLE(rw_scene_get_grid_statistics(NULL, &grid), "scene");
    NULL_HANDLE(rw_scene_intersect(NULL, &ray, &hit), "scene");
    NULL_HANDLE(rw_scene_intersect(committed, NULL, &hit), "ray");
    NULL_HANDLE(rw_scene_intersect(committed, &ray, NULL), "hit");
    NULL_HANDLE(rw_scene_occluded(NULL, &ray, &occluded), "scene");
    NULL_HANDLE(rw_scene_occluded(committed, NULL, &occluded), "ray");
    NULL_HANDLE(rw_scene_occluded(committed, &ray, NULL), "occluded");
    NULL_HANDLE(rw_scene_intersect_all(NULL, &ray, NULL, 0, &needed), "scene");
    NULL_HANDLE(rw_scene_intersect_all(committed, NULL, NULL, 0, &needed), "ray");
    NULL_HANDLE(rw_scene_intersect_all(committed, &ray, NULL, 0, NULL), "needed");
    NULL_HANDLE(rw_scene_intersect_all(committed, &ray, NULL, 1, &needed), "hits");
    NULL_HANDLE(rw_scene_intersect_batch(NULL, &rays, &hits, NULL), "scene");
    NULL_HANDLE(rw_scene_intersect_batch(committed, NULL, &hits, NULL), "rays");
    NULL_HANDLE(rw_scene_intersect_batch(committed, &rays, NULL, NULL), "hits");
    NULL_HANDLE(rw_scene_occluded_batch(NULL, &rays, &flags, NULL), "scene");
    NULL_HANDLE(rw_scene_occluded_batch(committed, NULL, &flags, NULL), "rays");
    NULL_HANDLE(rw_scene_occluded_batch(committed, &rays, NULL, NULL), "occluded");
    NULL_HANDLE(rw_scene_intersect_all_batch(NULL, &rays, offsets, NULL, 0, &needed, NULL), "scene");
    NULL_HANDLE(rw_scene_intersect_all_batch(committed, NULL, offsets, NULL, 0, &needed, NULL), "rays");
    NULL_HANDLE(rw_scene_intersect_all_batch(committed, &rays, NULL, NULL, 0, &needed, NULL), "offsets");
    NULL_HANDLE(rw_scene_intersect_all_batch(committed, &rays, offsets, NULL, 1, &needed, NULL), "hits");
    NULL_HANDLE(rw_scene_candidate_count(NULL, &number), "scene");
    NULL_HANDLE(rw_scene_candidate_count(committed, NULL), "count");
    NULL_HANDLE(rw_scene_get_candidate(NULL, 0, &candidate), "scene");
    NULL_HANDLE(rw_scene_get_candidate(committed, 0, NULL), "candidate");
    NULL_HANDLE(rw_scene_explain(NULL, 0, NULL, 0, &needed), "scene");
    NULL_HANDLE(rw_scene_explain(committed, 0, NULL, 1, &needed), "buffer");
    NULL_HANDLE(rw_view_create(NULL, &options, NULL, &view), "scene");
    NULL_HANDLE(rw_view_create(committed, NULL, NULL, &view), "options");
    NULL_HANDLE(rw_view_create(committed, &options, NULL, NULL), "view");
    NULL_HANDLE(rw_view_retain(NULL), "view");
    NULL_HANDLE(rw_view_intersect(NULL, &ray, &hit), "view");
    NULL_HANDLE(rw_view_intersect(view, NULL, &hit), "ray");
    NULL_HANDLE(rw_view_occluded(NULL, &ray, &occluded), "view");
    NULL_HANDLE(rw_view_intersect_all(NULL, &ray, NULL, 0, &needed), "view");
    NULL_HANDLE(rw_view_intersect_batch(NULL, &rays, &hits, NULL), "view");
    NULL_HANDLE(rw_view_occluded_batch(NULL, &rays, &flags, NULL), "view");
    NULL_HANDLE(rw_view_intersect_all_batch(NULL, &rays, offsets, NULL, 0, &needed, NULL), "view");
    NULL_HANDLE(rw_view_candidate_count(NULL, &number), "view");
    NULL_HANDLE(rw_view_get_candidate(NULL, 0, &candidate), "view");
    NULL_HANDLE(rw_view_explain(NULL, 0, NULL, 0, &needed), "view");
    NULL_HANDLE(rw_once_intersect(NULL, 1, &rays, &hits, NULL), "meshes");
    NULL_HANDLE(rw_once_intersect(&t, 1, NULL, &hits, NULL), "rays");
    NULL_HANDLE(rw_once_intersect(&t, 1, &rays, NULL, NULL), "hits");
    NULL_HANDLE(rw_once_occluded(NULL, 1, &rays, &flags, NULL), "meshes");
    NULL_HANDLE(rw_once_occluded(&t, 1, &rays, NULL, NULL), "occluded");

    /* Releasing nothing is fine. */
    CHECK_OK(rw_profile_release(NULL));
    CHECK_OK(rw_mesh_release(NULL));
    CHECK_OK(rw_scene_release(NULL));
    CHECK_OK(rw_view_release(NULL));
    /* One reference more and one less. */
    CHECK_OK(rw_scene_retain(committed));
    CHECK_OK(rw_scene_release(committed));
    CHECK_OK(rw_scene_intersect(committed, &ray, &hit));

    CHECK_ERROR(rw_structure_name(1000, &name), RW_ERROR_INVALID_ARGUMENT, "index|1000");
    CHECK_ERROR(rw_scene_get_candidate(committed, 1000, &candidate), RW_ERROR_INVALID_ARGUMENT, "index|1000");
    CHECK_ERROR(rw_scene_explain(committed, 7, NULL, 0, &needed), RW_ERROR_INVALID_ARGUMENT, "format|7");
    CHECK_ERROR(rw_profile_text(profile, -1, NULL, 0, &needed), RW_ERROR_INVALID_ARGUMENT, "format|-1");
}

/* struct_size: too small, absurd, and of a newer program. */
static void struct_sizes(void) {
    struct {
        rw_scene_statistics known;
        unsigned char later[24];
    } newer;
    struct {
        rw_triangles known;
        unsigned char later[24];
    } newer_triangles;
    struct {
        rw_query_options known;
        unsigned char later[2048];
    } newer_query;
    rw_once_options once;
    rw_output flags;
    rw_scene_statistics statistics;
    rw_triangles t = triangles_of(&s);
    rw_rays rays;
    rw_hits hits;
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    memset(&statistics, 0, sizeof statistics);
    CHECK_ERROR(rw_scene_get_statistics(committed, &statistics), RW_ERROR_INVALID_ARGUMENT,
                "statistics|struct_size is 0");
    statistics.struct_size = sizeof statistics - 8;
    CHECK_ERROR(rw_scene_get_statistics(committed, &statistics), RW_ERROR_INVALID_ARGUMENT, "struct_size");
    statistics.struct_size = 0xFFFFFFFFu;
    CHECK_ERROR(rw_scene_get_statistics(committed, &statistics), RW_ERROR_INVALID_ARGUMENT, "struct_size|4294967295");
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT, "rays|struct_size");
    rays.struct_size = sizeof rays;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT, "hits|struct_size");

    memset(&newer, 0, sizeof newer);
    newer.known.struct_size = sizeof newer;
    newer.later[0] = 0;
    CHECK_OK(rw_scene_get_statistics(committed, &newer.known));
    CHECK(newer.known.struct_size == sizeof newer && newer.known.triangle_count == s.triangles);

    memset(&newer_triangles, 0, sizeof newer_triangles);
    newer_triangles.known = t;
    newer_triangles.known.struct_size = sizeof newer_triangles;
    newer_triangles.later[5] = 1;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &newer_triangles.known, NULL), RW_ERROR_INVALID_ARGUMENT,
                "triangles|does not know");

    /* One struct inside another. */
    memset(&newer_query, 0, sizeof newer_query);
    memset(&once, 0, sizeof once);
    memset(&flags, 0, sizeof flags);
    newer_query.known.struct_size = sizeof newer_query;
    once.struct_size = sizeof once;
    once.query = &newer_query.known;
    hits.struct_size = sizeof hits;
    flags.data = &newer;
    CHECK_OK(rw_once_intersect(&t, 1, &rays, &hits, &once));
    CHECK_OK(rw_once_occluded(&t, 1, &rays, &flags, &once));
    newer_query.later[2047] = 1;
    CHECK_ERROR(rw_once_intersect(&t, 1, &rays, &hits, &once), RW_ERROR_INVALID_ARGUMENT,
                "options.query|does not know");
    CHECK_ERROR(rw_once_occluded(&t, 1, &rays, &flags, &once), RW_ERROR_INVALID_ARGUMENT,
                "options.query|does not know");
}

static void meshes_in_memory(void) {
    uint32_t geometry = 77;
    float *vertices = (float *)malloc((size_t)s.triangles * 9 * sizeof(float));
    uint32_t *indices = (uint32_t *)malloc((size_t)s.triangles * 3 * sizeof(uint32_t));
    double far[9] = {0, 0, 0, 1, 0, 0, 0, 1e39, 0};
    rw_triangles t = triangles_of(&s);
    if (vertices == NULL || indices == NULL) exit(1);
    memcpy(vertices, s.vertices, (size_t)s.triangles * 9 * sizeof(float));
    memcpy(indices, s.indices, (size_t)s.triangles * 3 * sizeof(uint32_t));
    t.vertices.data = vertices;
    t.indices.data = indices;

    vertices[3 * 41 + 2] = NAN;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_NOT_FINITE,
                "vertices|vertex 41|coordinate z|NaN");
    vertices[3 * 41 + 2] = -INFINITY;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_NOT_FINITE, "vertex 41|coordinate z|infinite");
    vertices[3 * 41 + 2] = 0.0f;
    indices[3 * 17 + 1] = 9000;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_INDEX_OUT_OF_RANGE,
                "triangle 17|index 9000|300 vertices");
    indices[3 * 17 + 1] = (uint32_t)t.vertex_count;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_INDEX_OUT_OF_RANGE, "triangle 17|index 300");
    indices[3 * 17 + 1] = 3 * 17 + 1;

    t.flags = 64;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_INVALID_ARGUMENT, "triangles|flags|64");
    t.flags = 0;
    t.vertices.type = RW_UINT32;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_INVALID_ARGUMENT, "triangles.vertices|type 4");
    t.vertices.type = 99;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_INVALID_ARGUMENT, "triangles.vertices|type 99");
    t.vertices.type = RW_FLOAT32;
    t.indices.type = RW_FLOAT64;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_INVALID_ARGUMENT, "triangles.indices|type 2");
    t.indices.type = RW_UINT32;
    t.vertices.data = NULL;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_INVALID_ARGUMENT, "triangles.vertices|NULL");
    t.vertices.data = vertices;
    t.indices.data = NULL;
    t.vertex_count = 10;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_INVALID_ARGUMENT, "indices|vertex_count is 10");
    t.indices.data = indices;
    t.vertex_count = (uint64_t)1 << 32;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_TOO_MANY, "vertex_count|4294967296");
    t.vertex_count = 3 * s.triangles;
    t.triangle_count = 0xFFFFFFFFu;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_TOO_MANY, "triangle_count|4294967295");

    memset(&t, 0, sizeof t);
    t.struct_size = sizeof t;
    t.vertex_count = 3;
    t.triangle_count = 1;
    t.vertices.data = far;
    t.vertices.type = RW_FLOAT64;
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_COORDINATE_RANGE, "vertex 2|coordinate y");
    CHECK(geometry == 77);
    free(vertices);
    free(indices);
}

static void before_and_after_the_commit(void) {
    rw_hit hit;
    rw_ray ray = random_ray();
    int32_t occluded;
    uint32_t number;
    uint64_t needed, offsets[1] = {0};
    double lower[3], upper[3];
    rw_triangles t = triangles_of(&s);
    rw_rays rays;
    rw_hits hits;
    rw_output flags;
    uint8_t flag;
    rw_scene_statistics statistics;
    rw_grid_statistics grid;
    rw_candidate candidate;
    rw_view_options options;
    rw_view *none = NULL;
    rw_expected_rays expected;
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    memset(&flags, 0, sizeof flags);
    memset(&options, 0, sizeof options);
    memset(&expected, 0, sizeof expected);
    rays.struct_size = sizeof rays;
    hits.struct_size = sizeof hits;
    flags.data = &flag;
    statistics.struct_size = sizeof statistics;
    grid.struct_size = sizeof grid;
    candidate.struct_size = sizeof candidate;
    options.struct_size = sizeof options;
    options.count = 1;
    expected.struct_size = sizeof expected;
    expected.count = 1;

#define TOO_EARLY(call) CHECK_ERROR(call, RW_ERROR_NOT_COMMITTED, "commit")
    TOO_EARLY(rw_scene_bounds(fresh, lower, upper));
    TOO_EARLY(rw_scene_get_statistics(fresh, &statistics));
    TOO_EARLY(rw_scene_get_grid_statistics(fresh, &grid));
    TOO_EARLY(rw_scene_intersect(fresh, &ray, &hit));
    TOO_EARLY(rw_scene_occluded(fresh, &ray, &occluded));
    TOO_EARLY(rw_scene_intersect_all(fresh, &ray, NULL, 0, &needed));
    TOO_EARLY(rw_scene_intersect_batch(fresh, &rays, &hits, NULL));
    TOO_EARLY(rw_scene_occluded_batch(fresh, &rays, &flags, NULL));
    TOO_EARLY(rw_scene_intersect_all_batch(fresh, &rays, offsets, NULL, 0, &needed, NULL));
    TOO_EARLY(rw_scene_candidate_count(fresh, &number));
    TOO_EARLY(rw_scene_get_candidate(fresh, 0, &candidate));
    TOO_EARLY(rw_scene_explain(fresh, 0, NULL, 0, &needed));
    TOO_EARLY(rw_view_create(fresh, &options, NULL, &none));

#define TOO_LATE(call) CHECK_ERROR(call, RW_ERROR_ALREADY_COMMITTED, "commit")
    TOO_LATE(rw_scene_add_triangles(committed, &t, NULL));
    TOO_LATE(rw_scene_set_expected_rays(committed, &expected));
    TOO_LATE(rw_scene_set_memory_limit(committed, 1));
    TOO_LATE(rw_scene_set_structure(committed, "bvh"));
    TOO_LATE(rw_scene_set_effort(committed, 0, 0, 0));
    TOO_LATE(rw_scene_commit(committed, NULL));
    CHECK_ERROR(rw_scene_get_grid_statistics(committed, &grid), RW_ERROR_WRONG_STRUCTURE, "linear_scan");
}

static void expectations(void) {
    rw_expected_rays expected;
    rw_view_options options;
    rw_once_options once;
    rw_rays rays;
    rw_hits hits;
    rw_triangles t = triangles_of(&s);
    rw_view *none = NULL;
    memset(&expected, 0, sizeof expected);
    memset(&options, 0, sizeof options);
    memset(&once, 0, sizeof once);
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    rays.struct_size = sizeof rays;
    hits.struct_size = sizeof hits;
    once.struct_size = sizeof once;
    expected.struct_size = sizeof expected;
    options.struct_size = sizeof options;

    CHECK_ERROR(rw_scene_set_expected_rays(fresh, &expected), RW_ERROR_RAY_COUNT, "expected.count|0");
    expected.count = RW_RAYS_LIMIT + 1;
    CHECK_ERROR(rw_scene_set_expected_rays(fresh, &expected), RW_ERROR_RAY_COUNT, "expected.count|1000000000000001");
    expected.count = RW_RAYS_UNKNOWN - 1;
    CHECK_ERROR(rw_scene_set_expected_rays(fresh, &expected), RW_ERROR_RAY_COUNT, "expected.count");
    expected.count = RW_RAYS_UNKNOWN;
    CHECK_OK(rw_scene_set_expected_rays(fresh, &expected));
    expected.count = RW_RAYS_LIMIT;
    CHECK_OK(rw_scene_set_expected_rays(fresh, &expected));
    expected.kind = 5;
    CHECK_ERROR(rw_scene_set_expected_rays(fresh, &expected), RW_ERROR_INVALID_ARGUMENT, "expected.kind|5");
    expected.kind = 0;
    expected.sample = &rays;
    rays.count = 3;
    CHECK_ERROR(rw_scene_set_expected_rays(fresh, &expected), RW_ERROR_INVALID_ARGUMENT, "expected.sample.origin|NULL");

    CHECK_ERROR(rw_scene_set_structure(fresh, "octree"), RW_ERROR_UNKNOWN_STRUCTURE, "octree|linear_scan|kd_tree");
    CHECK_ERROR(rw_scene_set_structure(fresh, ""), RW_ERROR_UNKNOWN_STRUCTURE, "structure");
    CHECK_ERROR(rw_scene_set_structure(fresh, "BVH"), RW_ERROR_UNKNOWN_STRUCTURE, "BVH");
    CHECK_ERROR(rw_scene_set_effort(fresh, 3, 0, 0), RW_ERROR_INVALID_ARGUMENT, "effort|3");
    CHECK_ERROR(rw_scene_set_effort(fresh, 0, -1, 0), RW_ERROR_INVALID_ARGUMENT, "rule|-1");
    CHECK_ERROR(rw_scene_set_effort(fresh, 0, 0, -1), RW_ERROR_INVALID_ARGUMENT, "time_limit_seconds");
    CHECK_ERROR(rw_scene_set_effort(fresh, 0, 0, NAN), RW_ERROR_INVALID_ARGUMENT, "time_limit_seconds");

    CHECK_ERROR(rw_view_create(committed, &options, NULL, &none), RW_ERROR_RAY_COUNT, "options.count|0");
    options.count = RW_RAYS_LIMIT + 1;
    CHECK_ERROR(rw_view_create(committed, &options, NULL, &none), RW_ERROR_RAY_COUNT, "options.count");
    options.count = 1;
    options.kind = 9;
    CHECK_ERROR(rw_view_create(committed, &options, NULL, &none), RW_ERROR_INVALID_ARGUMENT, "options.kind|9");
    options.kind = RW_VIEW_DIRECTION;
    CHECK_ERROR(rw_view_create(committed, &options, NULL, &none), RW_ERROR_INVALID_ARGUMENT, "options.direction|zero");
    options.direction[1] = NAN;
    CHECK_ERROR(rw_view_create(committed, &options, NULL, &none), RW_ERROR_NOT_FINITE, "options.direction");
    options.direction[1] = 1.0;
    options.kind = RW_VIEW_POINT;
    options.origin[2] = INFINITY;
    CHECK_ERROR(rw_view_create(committed, &options, NULL, &none), RW_ERROR_NOT_FINITE, "options.origin");
    options.origin[2] = 0.0;
    options.half_angle = 1.6;
    CHECK_ERROR(rw_view_create(committed, &options, NULL, &none), RW_ERROR_INVALID_ARGUMENT, "half_angle");
    options.half_angle = NAN;
    CHECK_ERROR(rw_view_create(committed, &options, NULL, &none), RW_ERROR_INVALID_ARGUMENT, "half_angle");
    options.half_angle = 0.5;
    options.ray_kind = 17;
    CHECK_ERROR(rw_view_create(committed, &options, NULL, &none), RW_ERROR_INVALID_ARGUMENT, "kind|17");
    options.ray_kind = 0;
    options.structure = "heap";
    CHECK_ERROR(rw_view_create(committed, &options, NULL, &none), RW_ERROR_UNKNOWN_STRUCTURE, "heap");
    CHECK(none == NULL);

    rays.count = 0;
    once.structure = "heap";
    CHECK_ERROR(rw_once_intersect(&t, 1, &rays, &hits, &once), RW_ERROR_UNKNOWN_STRUCTURE, "heap");
    once.structure = NULL;
    once.kind = -2;
    CHECK_ERROR(rw_once_intersect(&t, 1, &rays, &hits, &once), RW_ERROR_INVALID_ARGUMENT, "kind|-2");
    once.kind = 0;
    t.vertices.type = RW_UINT8;
    CHECK_ERROR(rw_once_intersect(&t, 1, &rays, &hits, &once), RW_ERROR_INVALID_ARGUMENT, "vertices|type 3");
}

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
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT, "hits.t");
    hits.t.stride = 4;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT, "hits.t|overlap");
    hits.t.stride = -7;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT, "hits.t|overlap");
    hits.t.stride = 0;
    hits.normal.data = out;
    hits.normal.type = RW_FLOAT64;
    hits.normal.component_stride = 4;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT,
                "hits.normal|overlap");
    hits.normal.component_stride = 8;
    hits.normal.stride = 8; /* y of one ray is x of the next */
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT,
                "hits.normal|overlap");
    hits.normal.stride = -16;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT,
                "hits.normal|overlap");
    hits.normal.data = NULL;
    rays.count = 1;
    hits.t.stride = RW_REPEAT;
    CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT, "hits.t");
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
    CHECK_OK(rw_scene_intersect_all(dense, &ray, NULL, 0, &needed));
    CHECK(needed > 2 && needed < 200);
    CHECK_OK(rw_scene_intersect_all(dense, &ray, hits, 200, &needed));
    CHECK_ERROR(rw_scene_intersect_all(dense, &ray, fewer, 2, &needed), RW_ERROR_CAPACITY, "hits|capacity is 2");
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

static void mesh_files(void) {
    rw_mesh *none = NULL;
    char path[600];
    CHECK_ERROR(rw_mesh_load("/nowhere/at/all.obj", &none), RW_ERROR_FILE_NOT_FOUND, "/nowhere/at/all.obj");
    CHECK_ERROR(rw_mesh_load("", &none), RW_ERROR_FILE_NOT_FOUND, "");
    snprintf(path, sizeof path, "%s/folder.obj", folder);
    mkdir(path, 0700);
    CHECK_ERROR(rw_mesh_load(path, &none), RW_ERROR_FILE_UNREADABLE, "folder.obj");
    rmdir(path);
    CHECK_ERROR(rw_mesh_load(file_with("a.stp", "ISO-10303-21;"), &none), RW_ERROR_FILE_FORMAT, ".stp");
    CHECK_ERROR(rw_mesh_load(file_with("a.ply", "solid"), &none), RW_ERROR_FILE_FORMAT, "a.ply");
    CHECK_ERROR(rw_mesh_load(file_with("a.off", "OFF\n3 1 0\n0 0 0\n"), &none), RW_ERROR_FILE_FORMAT, "truncated");
    CHECK_ERROR(rw_mesh_load(file_with("a.obj", "v 0 0 0\n"), &none), RW_ERROR_NO_FACES, "no faces");
    CHECK_ERROR(rw_mesh_load(file_with("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"), &none), RW_ERROR_BAD_POLYGON,
                "face 0 has 2 corners");
    CHECK_ERROR(rw_mesh_load(file_with("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n"), &none), RW_ERROR_INDEX_OUT_OF_RANGE,
                "face 0|index 3|2 vertices");
    CHECK_ERROR(rw_mesh_load(file_with("a.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n"), &none), RW_ERROR_NOT_FINITE,
                "vertex 1");
    CHECK_ERROR(rw_mesh_load(file_with("a.off", "OFF\n5000000000 1 0\n"), &none), RW_ERROR_TOO_MANY, "vertices");
    CHECK(none == NULL);
}

static void profiles(void) {
    rw_profile *p = NULL;
    rw_profile_info info;
    char path[600];
    uint64_t size = 0, i;
    char *text;
    CHECK_ERROR(rw_profile_load("/nowhere/profile.json", &p), RW_PROFILE_NOT_FOUND, "/nowhere/profile.json");
    CHECK(p != NULL);
    memset(&info, 0, sizeof info);
    info.struct_size = sizeof info;
    NEED_OK(rw_profile_inspect(p, &info));
    CHECK(info.source == RW_PROFILE_SOURCE_GENERIC && info.status == RW_PROFILE_NOT_FOUND &&
          strcmp(info.machine, "generic") == 0);
    CHECK(info.path != NULL && info.path[0] == '\0' && info.date != NULL && info.tool != NULL);
    rw_profile_release(p);
    p = NULL;

    snprintf(path, sizeof path, "%s/folder.json", folder);
    mkdir(path, 0700);
    CHECK_ERROR(rw_profile_load(path, &p), RW_PROFILE_UNREADABLE, "folder.json");
    CHECK(p != NULL);
    rw_profile_release(p);
    rmdir(path);
    CHECK_ERROR(rw_profile_load(file_with("p.json", ""), &p), RW_PROFILE_MALFORMED, "");
    rw_profile_release(p);
    CHECK_ERROR(rw_profile_load(file_with("p.json", "{\"schema\": "), &p), RW_PROFILE_MALFORMED, "");
    rw_profile_release(p);
    CHECK_ERROR(rw_profile_load(file_with("p.json", "[1, 2, 3]"), &p), RW_PROFILE_MALFORMED, "");
    rw_profile_release(p);

    /* The library's own text, cut off anywhere, is never taken for a profile and never a crash. */
    NEED_OK(rw_profile_text(profile, RW_FORMAT_JSON, NULL, 0, &size));
    text = (char *)malloc((size_t)size);
    if (text == NULL) exit(1);
    NEED_OK(rw_profile_text(profile, RW_FORMAT_JSON, text, size, &size));
    for (i = 1; i + 3 < size; i += 97) {
        const char kept = text[i];
        text[i] = '\0';
        p = NULL;
        CHECK(rw_profile_load(file_with("p.json", text), &p) >= RW_PROFILE_NOT_FOUND);
        CHECK(p != NULL);
        rw_profile_release(p);
        text[i] = kept;
    }
    free(text);
}

static void memory_limit(void) {
    rw_scene *scene = NULL;
    const rw_triangles t = triangles_of(&s);
    rw_hit hit;
    const rw_ray ray = random_ray();
    NEED_OK(rw_scene_create(profile, &scene));
    NEED_OK(rw_scene_add_triangles(scene, &t, NULL));
    CHECK_OK(rw_scene_set_memory_limit(scene, 1));
    CHECK_ERROR(rw_scene_commit(scene, NULL), RW_ERROR_MEMORY_LIMIT, "1");
    CHECK_OK(rw_scene_set_structure(scene, "kd_tree"));
    CHECK_ERROR(rw_scene_commit(scene, NULL), RW_ERROR_MEMORY_LIMIT, "kd_tree");
    /* The scene is as it was and may be committed again. */
    CHECK_OK(rw_scene_set_memory_limit(scene, 0));
    CHECK_OK(rw_scene_commit(scene, NULL));
    CHECK_OK(rw_scene_intersect(scene, &ray, &hit));
    rw_scene_release(scene);
}

int main(void) {
    rw_view_options options;
    const char *obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    rw_triangles t;
    use_all_helpers();
    if (mkdtemp(folder) == NULL) return 1;
    s = make_soup(100);
    t = triangles_of(&s);
    NEED_OK(rw_profile_load(NULL, &profile));
    NEED_OK(rw_scene_create(profile, &fresh));
    NEED_OK(rw_scene_add_triangles(fresh, &t, NULL));
    committed = make_scene(&s, "linear_scan");
    memset(&options, 0, sizeof options);
    options.struct_size = sizeof options;
    options.count = 100;
    NEED_OK(rw_view_create(committed, &options, NULL, &view));
    NEED_OK(rw_mesh_load(file_with("square.obj", obj), &mesh));

    handles_and_pointers();
    struct_sizes();
    meshes_in_memory();
    before_and_after_the_commit();
    expectations();
    batches();
    capacity();
    mesh_files();
    profiles();
    memory_limit();

    /* Whatever went wrong before, the scene is as it was. */
    CHECK_OK(rw_scene_set_structure(fresh, NULL));
    CHECK_OK(rw_scene_commit(fresh, NULL));
    rw_mesh_release(mesh);
    rw_view_release(view);
    rw_scene_release(fresh);
    rw_scene_release(committed);
    rw_profile_release(profile);
    free_soup(&s);
    {
        char command[600];
        snprintf(command, sizeof command, "rm -rf %s", folder);
        if (system(command) != 0) return 1;
    }
    return finish("errors");
}
