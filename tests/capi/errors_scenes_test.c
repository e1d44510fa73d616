/* Scenes and views: meshes that cannot be, calls before and after the commit, expectations, limits, callbacks. The status the
 * header promises, and a message that names argument and element. */
#include "errors_testing.h"

#include <stddef.h>

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
    t.triangle_count = 0xFFFFFFFEu; /* would do alone, but there are 100 in the scene */
    CHECK_ERROR(rw_scene_add_triangles(fresh, &t, &geometry), RW_ERROR_TOO_MANY, "triangle_count|4294967394");

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
    rw_scene *none = NULL;
    rw_scene *refitted = NULL;
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
    TOO_EARLY(rw_scene_intersect(fresh, &ray, NULL, &hit));
    TOO_EARLY(rw_scene_occluded(fresh, &ray, NULL, &occluded));
    TOO_EARLY(rw_scene_intersect_all(fresh, &ray, NULL, NULL, 0, &needed));
    TOO_EARLY(rw_scene_intersect_batch(fresh, &rays, &hits, NULL));
    TOO_EARLY(rw_scene_occluded_batch(fresh, &rays, &flags, NULL));
    TOO_EARLY(rw_scene_intersect_all_batch(fresh, &rays, offsets, NULL, 0, &needed, NULL));
    TOO_EARLY(rw_scene_candidate_count(fresh, &number));
    TOO_EARLY(rw_scene_get_candidate(fresh, 0, &candidate));
    TOO_EARLY(rw_scene_explain(fresh, 0, NULL, 0, &needed));
    TOO_EARLY(rw_scene_view(fresh, &options, NULL, &none));
    TOO_EARLY(rw_scene_refit(fresh, &t, 1, NULL, &refitted));
    CHECK(refitted == NULL);

#define TOO_LATE(call) CHECK_ERROR(call, RW_ERROR_ALREADY_COMMITTED, "commit")
    TOO_LATE(rw_scene_add_triangles(committed, &t, NULL));
    TOO_LATE(rw_scene_set_expected_rays(committed, &expected));
    TOO_LATE(rw_scene_set_memory_limit(committed, 1));
    TOO_LATE(rw_scene_set_structure(committed, "bvh"));
    TOO_LATE(rw_scene_set_effort(committed, 0, 0, 0));
    TOO_LATE(rw_scene_commit(committed, NULL));
    CHECK_ERROR(rw_scene_get_grid_statistics(committed, &grid), RW_ERROR_WRONG_STRUCTURE, "linear_scan");
}

static void refits(void) {
    rw_scene *scene = NULL, *none = NULL, *other = NULL;
    rw_commit_options options;
    rw_triangles meshes[3];
    float *vertices = (float *)malloc((size_t)s.triangles * 9 * sizeof(float));
    uint32_t *indices = (uint32_t *)malloc((size_t)s.triangles * 3 * sizeof(uint32_t));
    const double far[9] = {0, 0, 0, 1, 0, 0, 0, 1e39, 0};
    if (vertices == NULL || indices == NULL) exit(1);
    memcpy(vertices, s.vertices, (size_t)s.triangles * 9 * sizeof(float));
    memcpy(indices, s.indices, (size_t)s.triangles * 3 * sizeof(uint32_t));
    NEED_OK(rw_scene_create(profile, &scene));
    meshes[0] = meshes[1] = meshes[2] = triangles_of(&s);
    meshes[1].triangle_count = 17;
    NEED_OK(rw_scene_add_triangles(scene, &meshes[0], NULL));
    NEED_OK(rw_scene_add_triangles(scene, &meshes[1], NULL));
    NEED_OK(rw_scene_set_structure(scene, "bvh"));
    NEED_OK(rw_scene_commit(scene, NULL));

#define REFIT(count) rw_scene_refit(scene, meshes, (count), NULL, &none)
    CHECK_ERROR(REFIT(0), RW_ERROR_INVALID_ARGUMENT, "mesh_count: it is 0|2 meshes");
    CHECK_ERROR(REFIT(1), RW_ERROR_INVALID_ARGUMENT, "mesh_count: it is 1|2 meshes");
    CHECK_ERROR(REFIT(3), RW_ERROR_INVALID_ARGUMENT, "mesh_count: it is 3|2 meshes");
    meshes[1].triangle_count = 18;
    CHECK_ERROR(REFIT(2), RW_ERROR_INVALID_ARGUMENT, "meshes[1].triangle_count: it is 18|17 triangles");
    memset(&options, 0, sizeof options);
    options.struct_size = sizeof options;
    options.refit = RW_REFIT_NEVER; /* other numbers are fine then, */
    NEED_OK(rw_scene_refit(scene, meshes, 2, &options, &other));
    CHECK_OK(rw_scene_release(other));
    NEED_OK(rw_scene_refit(scene, meshes, 1, &options, &other));
    CHECK_OK(rw_scene_release(other));
    meshes[1].indices.data = NULL; /* but not of indices that are kept */
    CHECK_ERROR(rw_scene_refit(scene, meshes, 2, &options, &none), RW_ERROR_INVALID_ARGUMENT,
                "meshes[1].triangle_count: it is 18|indices are kept|17 triangles");
    options.refit = 3;
    CHECK_ERROR(rw_scene_refit(scene, meshes, 2, &options, &none), RW_ERROR_INVALID_ARGUMENT, "options.refit: 3");
    options.refit = -1;
    CHECK_ERROR(rw_scene_refit(scene, meshes, 2, &options, &none), RW_ERROR_INVALID_ARGUMENT, "options.refit: -1");
    CHECK_ERROR(rw_scene_commit(scene, &options), RW_ERROR_INVALID_ARGUMENT, "options.refit: -1");
    options.refit = RW_REFIT_WHERE_POSSIBLE;
    options.reserved = 1;
    CHECK_ERROR(rw_scene_refit(scene, meshes, 2, &options, &none), RW_ERROR_RESERVED, "options.reserved");
    options.struct_size = (uint32_t)offsetof(rw_commit_options, refit); /* of the version before, which had none */
    meshes[1].indices.data = s.indices;
    meshes[1].triangle_count = 17;
    NEED_OK(rw_scene_refit(scene, meshes, 2, &options, &other));
    CHECK_OK(rw_scene_release(other));
    meshes[1].indices.data = NULL;
    meshes[1].vertex_count = 51;
    CHECK_ERROR(REFIT(2), RW_ERROR_INVALID_ARGUMENT, "meshes[1].vertex_count: it is 51|300 vertices");
    meshes[1] = triangles_of(&s);
    meshes[1].triangle_count = 17;
    meshes[1].vertices.data = vertices;
    meshes[1].indices.data = indices;
    vertices[3 * 41 + 2] = NAN;
    CHECK_ERROR(REFIT(2), RW_ERROR_NOT_FINITE, "meshes[1].vertices: vertex 41: coordinate z is NaN");
    vertices[3 * 41 + 2] = 0.0f;
    indices[3 * 16 + 1] = 9000;
    CHECK_ERROR(REFIT(2), RW_ERROR_INDEX_OUT_OF_RANGE, "meshes[1].triangle 16: index 9000|300 vertices");
    indices[3 * 16 + 1] = 0;
    meshes[1].flags = 64;
    CHECK_ERROR(REFIT(2), RW_ERROR_INVALID_ARGUMENT, "meshes[1]: flags 64");
    meshes[1].flags = 0;
    meshes[1].vertices.type = RW_UINT32;
    CHECK_ERROR(REFIT(2), RW_ERROR_INVALID_ARGUMENT, "meshes[1].vertices: type 4");
    meshes[1].vertices.type = 0;
    meshes[1].indices.type = RW_FLOAT64;
    CHECK_ERROR(REFIT(2), RW_ERROR_INVALID_ARGUMENT, "meshes[1].indices: type 2");
    meshes[1].indices.type = 0;
    meshes[1].vertices.data = NULL;
    CHECK_ERROR(REFIT(2), RW_ERROR_INVALID_ARGUMENT, "meshes[1].vertices: data is NULL");
    meshes[1].vertices.data = far;
    meshes[1].vertices.type = RW_FLOAT64;
    meshes[1].vertex_count = 3;
    CHECK_ERROR(REFIT(2), RW_ERROR_COORDINATE_RANGE, "meshes[1].vertices: vertex 2: coordinate y");
    CHECK(none == NULL);
    meshes[1] = triangles_of(&s);
    meshes[1].triangle_count = 17;
    CHECK_OK(REFIT(2));
    rw_scene_release(none);
    rw_scene_release(scene);
    free(vertices);
    free(indices);
}

static void expectations(void) {
    rw_expected_rays expected;
    rw_view_options options;
    rw_once_options once;
    rw_rays rays;
    rw_hits hits;
    rw_triangles t = triangles_of(&s);
    rw_scene *none = NULL;
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

    CHECK_ERROR(rw_scene_view(committed, &options, NULL, &none), RW_ERROR_RAY_COUNT, "options.count|0");
    options.count = RW_RAYS_LIMIT + 1;
    CHECK_ERROR(rw_scene_view(committed, &options, NULL, &none), RW_ERROR_RAY_COUNT, "options.count");
    options.count = 1;
    options.kind = 9;
    CHECK_ERROR(rw_scene_view(committed, &options, NULL, &none), RW_ERROR_INVALID_ARGUMENT, "options.kind|9");
    options.kind = RW_VIEW_DIRECTION;
    CHECK_ERROR(rw_scene_view(committed, &options, NULL, &none), RW_ERROR_INVALID_ARGUMENT, "options.direction|zero");
    options.direction[1] = NAN;
    CHECK_ERROR(rw_scene_view(committed, &options, NULL, &none), RW_ERROR_NOT_FINITE, "options.direction");
    options.direction[1] = 1.0;
    options.kind = RW_VIEW_POINT;
    options.origin[2] = INFINITY;
    CHECK_ERROR(rw_scene_view(committed, &options, NULL, &none), RW_ERROR_NOT_FINITE, "options.origin");
    options.origin[2] = 0.0;
    options.half_angle = 1.6;
    CHECK_ERROR(rw_scene_view(committed, &options, NULL, &none), RW_ERROR_INVALID_ARGUMENT, "half_angle");
    options.half_angle = NAN;
    CHECK_ERROR(rw_scene_view(committed, &options, NULL, &none), RW_ERROR_INVALID_ARGUMENT, "half_angle");
    options.half_angle = 0.5;
    options.ray_kind = 17;
    CHECK_ERROR(rw_scene_view(committed, &options, NULL, &none), RW_ERROR_INVALID_ARGUMENT, "kind|17");
    options.ray_kind = 0;
    options.structure = "heap";
    CHECK_ERROR(rw_scene_view(committed, &options, NULL, &none), RW_ERROR_UNKNOWN_STRUCTURE, "heap");
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
    CHECK_OK(rw_scene_intersect(scene, &ray, NULL, &hit));
    rw_scene_release(scene);
}

/* With a rule and efforts that build before they decide. */
static void memory_limit_of_builders(void) {
    static const struct {
        int32_t effort, rule;
    } ways[] = {{RW_EFFORT_PROBE, RW_RULE_SMALLEST_TOTAL},
                {RW_EFFORT_MEASURE, RW_RULE_SMALLEST_TOTAL},
                {RW_EFFORT_ESTIMATE, RW_RULE_HAPALA}};
    const rw_triangles t = triangles_of(&s);
    size_t i;
    for (i = 0; i < sizeof ways / sizeof ways[0]; ++i) {
        rw_scene *scene = NULL;
        NEED_OK(rw_scene_create(profile, &scene));
        NEED_OK(rw_scene_add_triangles(scene, &t, NULL));
        CHECK_OK(rw_scene_set_effort(scene, ways[i].effort, ways[i].rule, 0.0));
        CHECK_OK(rw_scene_set_memory_limit(scene, 1));
        CHECK_ERROR(rw_scene_commit(scene, NULL), RW_ERROR_MEMORY_LIMIT, "smallest candidate|memory limit is 1");
        CHECK_OK(rw_scene_set_memory_limit(scene, 0));
        CHECK_OK(rw_scene_commit(scene, NULL));
        rw_scene_release(scene);
    }
}

static int32_t stop(void *user, double fraction, const char *stage) {
    (void)user;
    (void)fraction;
    (void)stage;
    return 1;
}
static void leave_the_last_out(void *user, uint64_t count, rw_task task, void *task_data) {
    uint64_t i;
    (void)user;
    for (i = 0; i + 1 < count; ++i) task(task_data, i);
}
static void run_the_first_twice(void *user, uint64_t count, rw_task task, void *task_data) {
    uint64_t i;
    (void)user;
    for (i = 0; i < count; ++i) task(task_data, i);
    task(task_data, 0);
}
static void go_beyond(void *user, uint64_t count, rw_task task, void *task_data) {
    uint64_t i;
    (void)user;
    for (i = 0; i <= count; ++i) task(task_data, i);
}

static void callbacks(void) {
    static const struct {
        rw_parallel_for loop;
        const char *parts;
    } loops[] = {{leave_the_last_out, "parallel_for|called 0 times"},
                 {run_the_first_twice, "parallel_for|task 0|called 2 times"},
                 {go_beyond, "parallel_for|or more"}};
    rw_commit_options commit;
    rw_query_options query;
    rw_once_options once;
    rw_view_options options;
    rw_scene *none = NULL;
    rw_rays rays;
    rw_hits hits;
    rw_scene *scene = NULL, *tree = make_scene(&s, "bvh"), *refitted = NULL;
    const rw_triangles t = triangles_of(&s);
    double numbers[3] = {0, 0, 1}, out[1];
    size_t i;
    memset(&commit, 0, sizeof commit);
    memset(&query, 0, sizeof query);
    memset(&once, 0, sizeof once);
    memset(&options, 0, sizeof options);
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    commit.struct_size = sizeof commit;
    query.struct_size = sizeof query;
    once.struct_size = sizeof once;
    once.query = &query;
    options.struct_size = sizeof options;
    options.count = 1;
    options.structure = "projected_bvh";
    rays.struct_size = sizeof rays;
    rays.count = 1;
    rays.origin.data = numbers;
    rays.origin.type = RW_FLOAT64;
    rays.direction = rays.origin;
    hits.struct_size = sizeof hits;
    hits.t.data = out;
    hits.t.type = RW_FLOAT64;

    NEED_OK(rw_scene_create(profile, &scene));
    NEED_OK(rw_scene_add_triangles(scene, &t, NULL));
    CHECK_OK(rw_scene_set_structure(scene, "uniform_grid"));
    commit.progress = stop;
    CHECK_ERROR(rw_scene_commit(scene, &commit), RW_ERROR_CANCELLED, "progress callback");
    CHECK_ERROR(rw_scene_view(committed, &options, &commit, &none), RW_ERROR_CANCELLED, "progress callback");
    CHECK_ERROR(rw_scene_refit(tree, &t, 1, &commit, &refitted), RW_ERROR_CANCELLED, "progress callback");
    commit.progress = NULL;
    for (i = 0; i < sizeof loops / sizeof loops[0]; ++i) {
        commit.parallel_for = query.parallel_for = loops[i].loop;
        CHECK_ERROR(rw_scene_commit(scene, &commit), RW_ERROR_HOST_PARALLEL, loops[i].parts);
        CHECK_ERROR(rw_scene_view(committed, &options, &commit, &none), RW_ERROR_HOST_PARALLEL, loops[i].parts);
        CHECK_ERROR(rw_scene_refit(tree, &t, 1, &commit, &refitted), RW_ERROR_HOST_PARALLEL, loops[i].parts);
        CHECK_ERROR(rw_scene_intersect_batch(committed, &rays, &hits, &query), RW_ERROR_HOST_PARALLEL, loops[i].parts);
        CHECK_ERROR(rw_once_intersect(&t, 1, &rays, &hits, &once), RW_ERROR_HOST_PARALLEL, loops[i].parts);
    }
    CHECK(none == NULL && refitted == NULL);
    CHECK_OK(rw_scene_commit(scene, NULL));
    rw_scene_release(scene);
    rw_scene_release(tree);
}

int main(void) {
    set_up();
    meshes_in_memory();
    before_and_after_the_commit();
    refits();
    expectations();
    memory_limit();
    memory_limit_of_builders();
    callbacks();
    return tear_down("errors of scenes");
}
