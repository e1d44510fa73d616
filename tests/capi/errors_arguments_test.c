/* Misuse that every function may meet: NULL where something is needed, a struct_size that cannot be, an index beyond the end.
 * The status the header promises, and a message that names the argument. */
#include "errors_testing.h"

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
    rw_scene *refitted = NULL;
    const rw_ray_f32 ray32 = {{0, 0, 5}, 0, {0, 0, -1}, INFINITY};
    rw_hit_f32 hit32;
    float normal32;
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
    NULL_HANDLE(rw_abi_version(NULL), "abi");
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
    NULL_HANDLE(rw_scene_refit(NULL, &t, 1, NULL, &refitted), "scene");
    NULL_HANDLE(rw_scene_refit(committed, NULL, 1, NULL, &refitted), "meshes");
    NULL_HANDLE(rw_scene_refit(committed, &t, 1, NULL, NULL), "refitted");
    CHECK(refitted == NULL);
    NULL_HANDLE(rw_scene_bounds(NULL, lower, upper), "scene");
    NULL_HANDLE(rw_scene_bounds(committed, NULL, upper), "lower");
    NULL_HANDLE(rw_scene_bounds(committed, lower, NULL), "upper");
    NULL_HANDLE(rw_scene_get_statistics(NULL, &statistics), "scene");
    NULL_HANDLE(rw_scene_get_statistics(committed, NULL), "statistics");
    NULL_HANDLE(rw_scene_get_grid_statistics(NULL, &grid), "scene");
    NULL_HANDLE(rw_scene_intersect(NULL, &ray, NULL, &hit), "scene");
    NULL_HANDLE(rw_scene_intersect(committed, NULL, NULL, &hit), "ray");
    NULL_HANDLE(rw_scene_intersect(committed, &ray, NULL, NULL), "hit");
    NULL_HANDLE(rw_scene_occluded(NULL, &ray, NULL, &occluded), "scene");
    NULL_HANDLE(rw_scene_occluded(committed, NULL, NULL, &occluded), "ray");
    NULL_HANDLE(rw_scene_occluded(committed, &ray, NULL, NULL), "occluded");
    NULL_HANDLE(rw_scene_intersect_all(NULL, &ray, NULL, NULL, 0, &needed), "scene");
    NULL_HANDLE(rw_scene_intersect_all(committed, NULL, NULL, NULL, 0, &needed), "ray");
    NULL_HANDLE(rw_scene_intersect_all(committed, &ray, NULL, NULL, 0, NULL), "needed");
    NULL_HANDLE(rw_scene_intersect_all(committed, &ray, NULL, NULL, 1, &needed), "hits");
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
    NULL_HANDLE(rw_scene_view(NULL, &options, NULL, &view), "scene");
    NULL_HANDLE(rw_scene_view(committed, NULL, NULL, &view), "options");
    NULL_HANDLE(rw_scene_view(committed, &options, NULL, NULL), "view");
    NULL_HANDLE(rw_scene_intersect(view, NULL, NULL, &hit), "ray");
    NULL_HANDLE(rw_scene_intersect_f32(NULL, &ray32, NULL, &hit32), "scene");
    NULL_HANDLE(rw_scene_intersect_f32(committed, NULL, NULL, &hit32), "ray");
    NULL_HANDLE(rw_scene_intersect_f32(committed, &ray32, NULL, NULL), "hit");
    NULL_HANDLE(rw_scene_occluded_f32(NULL, &ray32, NULL, &occluded), "scene");
    NULL_HANDLE(rw_scene_occluded_f32(committed, NULL, NULL, &occluded), "ray");
    NULL_HANDLE(rw_scene_occluded_f32(committed, &ray32, NULL, NULL), "occluded");
    NULL_HANDLE(rw_scene_intersect_all_f32(NULL, &ray32, NULL, NULL, 0, &needed), "scene");
    NULL_HANDLE(rw_scene_intersect_all_f32(committed, NULL, NULL, NULL, 0, &needed), "ray");
    NULL_HANDLE(rw_scene_intersect_all_f32(committed, &ray32, NULL, NULL, 0, NULL), "needed");
    NULL_HANDLE(rw_scene_intersect_all_f32(committed, &ray32, NULL, NULL, 1, &needed), "hits");
    NULL_HANDLE(rw_scene_normal(NULL, &hit, lower), "scene");
    NULL_HANDLE(rw_scene_normal(committed, NULL, lower), "hit");
    NULL_HANDLE(rw_scene_normal(committed, &hit, NULL), "normal");
    NULL_HANDLE(rw_scene_normal_f32(NULL, &hit32, &normal32), "scene");
    NULL_HANDLE(rw_scene_normal_f32(committed, NULL, &normal32), "hit");
    NULL_HANDLE(rw_scene_normal_f32(committed, &hit32, NULL), "normal");
    NULL_HANDLE(rw_once_intersect(NULL, 1, &rays, &hits, NULL), "meshes");
    NULL_HANDLE(rw_once_intersect(&t, 1, NULL, &hits, NULL), "rays");
    NULL_HANDLE(rw_once_intersect(&t, 1, &rays, NULL, NULL), "hits");
    NULL_HANDLE(rw_once_occluded(NULL, 1, &rays, &flags, NULL), "meshes");
    NULL_HANDLE(rw_once_occluded(&t, 1, &rays, NULL, NULL), "occluded");

    /* Releasing nothing is fine. */
    CHECK_OK(rw_profile_release(NULL));
    CHECK_OK(rw_mesh_release(NULL));
    CHECK_OK(rw_scene_release(NULL));
    /* One reference more and one less. */
    CHECK_OK(rw_scene_retain(committed));
    CHECK_OK(rw_scene_release(committed));
    CHECK_OK(rw_scene_intersect(committed, &ray, NULL, &hit));

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
    statistics.struct_size = sizeof statistics - 16;
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

/* A struct_size that is none of today's nor of an earlier version, in every struct that has one and every call that takes it. */
static void struct_sizes_of_all(void) {
    rw_scene *refitted = NULL;
    static const uint32_t sizes[] = {0, 1, 4, 12, 4097, 0xFFFFFFFFu};
    rw_profile_info info;
    rw_triangles t = triangles_of(&s), three[3];
    rw_rays rays, sample;
    rw_hits hits;
    rw_output flags;
    rw_query_options query;
    rw_ray_options ray_options;
    rw_expected_rays expected;
    rw_commit_options commit;
    rw_scene_statistics statistics;
    rw_grid_statistics grid;
    rw_candidate candidate;
    rw_view_options options;
    rw_once_options once;
    rw_scene *on_grid = make_scene(&s, "uniform_grid");
    const rw_ray ray = random_ray();
    rw_hit hit;
    rw_scene *none = NULL;
    uint8_t flag;
    uint64_t offsets[1];
    size_t i;
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    memset(&flags, 0, sizeof flags);
    memset(&query, 0, sizeof query);
    memset(&ray_options, 0, sizeof ray_options);
    memset(&expected, 0, sizeof expected);
    memset(&commit, 0, sizeof commit);
    memset(&options, 0, sizeof options);
    memset(&once, 0, sizeof once);
    flags.data = &flag;
    expected.count = options.count = 1;
    rays.struct_size = sizeof rays;
    hits.struct_size = sizeof hits;
    sample = rays;

#define BAD_SIZE(of, call, name)                                                \
    do {                                                                        \
        const uint32_t good = (uint32_t)sizeof(of);                             \
        (of).struct_size = sizes[i];                                            \
        CHECK_ERROR(call, RW_ERROR_INVALID_ARGUMENT, name ": struct_size is "); \
        (of).struct_size = good;                                                \
    } while (0)
    for (i = 0; i < sizeof sizes / sizeof sizes[0]; ++i) {
        BAD_SIZE(info, rw_profile_inspect(profile, &info), "info");
        BAD_SIZE(t, rw_mesh_triangles(mesh, &t), "triangles");
        t = triangles_of(&s);
        BAD_SIZE(t, rw_scene_add_triangles(fresh, &t, NULL), "triangles");
        BAD_SIZE(expected, rw_scene_set_expected_rays(fresh, &expected), "expected");
        expected.sample = &sample;
        BAD_SIZE(sample, rw_scene_set_expected_rays(fresh, &expected), "expected.sample");
        expected.sample = NULL;
        BAD_SIZE(commit, rw_scene_commit(fresh, &commit), "options");
        BAD_SIZE(commit, rw_scene_refit(committed, &t, 1, &commit, &refitted), "options");
        BAD_SIZE(t, rw_scene_refit(committed, &t, 1, NULL, &refitted), "meshes[0]");
        BAD_SIZE(statistics, rw_scene_get_statistics(committed, &statistics), "statistics");
        BAD_SIZE(grid, rw_scene_get_grid_statistics(on_grid, &grid), "statistics");
        BAD_SIZE(candidate, rw_scene_get_candidate(committed, 0, &candidate), "candidate");
        BAD_SIZE(candidate, rw_scene_get_candidate(view, 0, &candidate), "candidate");
        BAD_SIZE(ray_options, rw_scene_intersect(committed, &ray, &ray_options, &hit), "options");
        BAD_SIZE(ray_options, rw_scene_intersect(view, &ray, &ray_options, &hit), "options");
        BAD_SIZE(rays, rw_scene_intersect_batch(committed, &rays, &hits, NULL), "rays");
        BAD_SIZE(hits, rw_scene_intersect_batch(committed, &rays, &hits, NULL), "hits");
        BAD_SIZE(query, rw_scene_intersect_batch(committed, &rays, &hits, &query), "options");
        BAD_SIZE(query, rw_scene_occluded_batch(committed, &rays, &flags, &query), "options");
        BAD_SIZE(hits, rw_scene_intersect_all_batch(committed, &rays, offsets, &hits, 1, NULL, NULL), "hits");
        BAD_SIZE(query, rw_scene_intersect_all_batch(committed, &rays, offsets, NULL, 0, NULL, &query), "options");
        BAD_SIZE(rays, rw_scene_intersect_batch(view, &rays, &hits, NULL), "rays");
        BAD_SIZE(options, rw_scene_view(committed, &options, NULL, &none), "options");
        BAD_SIZE(commit, rw_scene_view(committed, &options, &commit, &none), "commit");
        BAD_SIZE(once, rw_once_intersect(&t, 1, &rays, &hits, &once), "options");
        once.query = &query;
        BAD_SIZE(query, rw_once_intersect(&t, 1, &rays, &hits, &once), "options.query");
        once.query = NULL;
        BAD_SIZE(t, rw_once_intersect(&t, 1, &rays, &hits, &once), "meshes[0]");
        BAD_SIZE(rays, rw_once_occluded(&t, 1, &rays, &flags, &once), "rays");
    }
    CHECK(none == NULL);
    memset(three, 0, sizeof three);
    three[0] = three[1] = t;
    three[1].struct_size = sizeof t + 8; /* into the third, which is all zero */
    CHECK_ERROR(rw_once_intersect(three, 2, &rays, &hits, NULL), RW_ERROR_INVALID_ARGUMENT,
                "meshes[1]|struct_size differs from that of meshes[0]");
    CHECK_ERROR(rw_scene_refit(committed, three, 2, NULL, &refitted), RW_ERROR_INVALID_ARGUMENT,
                "meshes[1]|struct_size differs from that of meshes[0]");
    CHECK(refitted == NULL);
    rw_scene_release(on_grid);
}

int main(void) {
    set_up();
    handles_and_pointers();
    struct_sizes();
    struct_sizes_of_all();
    return tear_down("errors of arguments");
}
