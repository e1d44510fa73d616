/* A whole program, from a profile to explain, with one allocation after the other refused: once that one alone, once it and
 * all that follow. The call that met the refusal says so and has changed nothing; repeated, it does what it does without
 * refusals; in the end everything has been given back. */
#include "testing.h"

#include "refusing.h"

#define RAYS 12
#define TRIANGLES 60
#define MOST (TRIANGLES + 4) /* hits of a ray */

/* What is built. */
typedef struct plan {
    const char *structure; /* NULL: the library chooses */
    int32_t effort;
    int32_t rule;
} plan;

/* What is answered, byte for byte: reference and repetition are compared as memory. */
typedef struct answers {
    rw_hit single[RAYS];
    int32_t occluded[RAYS];
    rw_hit skipping;
    rw_hit all[MOST];
    uint64_t all_count;
    double t[RAYS], normal[3 * RAYS];
    uint32_t primitive[RAYS];
    uint8_t flags[RAYS];
    uint64_t offsets[RAYS + 1];
    float all_t[RAYS * MOST];
    rw_hit view_single[RAYS];
    double view_t[RAYS];
    uint64_t view_offsets[RAYS + 1];
    double once_t[RAYS];
    rw_hit moved[RAYS];
    double lower[3], upper[3];
    char profile_text[8192];
} answers;

static soup some;                /* float32, indexed */
static double wide_vertices[18]; /* float64, not indexed */
static uint64_t wide_indices[6]; /* float64, indexed with uint64 */
static float moved_vertices[9 * TRIANGLES];
static rw_ray rays_in[RAYS];
static long attempts;     /* calls that said out of memory */
static int keep_refusing; /* a refused call is tried once more before memory is given freely again */

static const char unchanged_text[] = "unchanged";

/* Runs a call; when memory is refused to it, checks the status and that nothing was changed, and runs it again with all the
 * memory it wants. */
#define CALL(call, unchanged)                                                 \
    do {                                                                      \
        int32_t status = (call);                                              \
        if (status == RW_ERROR_OUT_OF_MEMORY) {                               \
            ++attempts;                                                       \
            CHECK(strstr(rw_last_error_message(), "memory") != NULL);         \
            if (keep_refusing) {                                              \
                status = (call);                                              \
                CHECK(status == RW_ERROR_OUT_OF_MEMORY);                      \
            }                                                                 \
            stop_refusing();                                                  \
            CHECK((unchanged));                                               \
            status = (call);                                                  \
        }                                                                     \
        if (!check_that(status == RW_OK, #call, __FILE__, __LINE__)) exit(1); \
    } while (0)

/* Outputs are all zero before the first call that writes them. */
static int is_zero(const void *memory, size_t size) {
    const unsigned char *bytes = (const unsigned char *)memory;
    size_t i;
    for (i = 0; i < size; ++i)
        if (bytes[i] != 0) return 0;
    return 1;
}
#define UNWRITTEN(output) is_zero(&(output), sizeof(output))

static int is_open(const rw_scene *scene) {
    rw_scene_statistics statistics;
    statistics.struct_size = sizeof statistics;
    return rw_scene_get_statistics(scene, &statistics) == RW_ERROR_NOT_COMMITTED;
}

static rw_rays all_rays(void) {
    rw_rays rays;
    memset(&rays, 0, sizeof rays);
    rays.struct_size = sizeof rays;
    rays.count = RAYS;
    rays.origin.data = rays_in[0].origin;
    rays.origin.stride = sizeof(rw_ray);
    rays.origin.type = RW_FLOAT64;
    rays.direction = rays.origin;
    rays.direction.data = rays_in[0].direction;
    return rays;
}

static rw_hits only_t(double *t) {
    rw_hits hits;
    memset(&hits, 0, sizeof hits);
    hits.struct_size = sizeof hits;
    hits.t.data = t;
    hits.t.type = RW_FLOAT64;
    return hits;
}

static void fill(rw_scene *scene) {
    rw_triangles t = triangles_of(&some);
    uint32_t geometry = 99;
    CALL(rw_scene_add_triangles(scene, &t, &geometry), geometry == 99 && is_open(scene));
    CHECK(geometry == 0);
    t.vertex_count = 6;
    t.vertices.data = wide_vertices;
    t.vertices.type = RW_FLOAT64;
    t.triangle_count = 2;
    t.indices.data = NULL;
    CALL(rw_scene_add_triangles(scene, &t, &geometry), geometry == 0 && is_open(scene));
    CHECK(geometry == 1);
    t.indices.data = wide_indices;
    t.indices.type = RW_UINT64;
    t.flags = RW_TRIANGLES_SHARED | RW_TRIANGLES_SKIP_INVALID;
    CALL(rw_scene_add_triangles(scene, &t, NULL), is_open(scene));
}

static void build(rw_scene *scene, const plan *p, const rw_commit_options *one_thread) {
    const rw_rays sample = all_rays();
    rw_expected_rays expected;
    memset(&expected, 0, sizeof expected);
    expected.struct_size = sizeof expected;
    expected.kind = RW_RAYS_CAMERA;
    expected.count = 1000;
    expected.sample = &sample;
    CALL(rw_scene_set_expected_rays(scene, &expected), is_open(scene));
    CALL(rw_scene_set_effort(scene, p->effort, p->rule, 0.0), is_open(scene));
    CALL(rw_scene_set_structure(scene, p->structure), is_open(scene));
    CALL(rw_scene_commit(scene, one_thread), is_open(scene));
}

static void ask_scene(const rw_scene *scene, const rw_query_options *query, answers *a) {
    const rw_rays rays = all_rays();
    rw_hits hits = only_t(a->t), all = only_t(NULL);
    rw_output flags;
    uint64_t needed = 0;
    int i;
    const rw_primitive_id skip = {RW_INVALID_ID, 0, 3};
    rw_ray_options skipping;
    memset(&skipping, 0, sizeof skipping);
    skipping.struct_size = sizeof skipping;
    skipping.skip = &skip;
    skipping.skip_count = 1;
    for (i = 0; i < RAYS; ++i) {
        CALL(rw_scene_intersect(scene, &rays_in[i], NULL, &a->single[i]), UNWRITTEN(a->single[i]));
        CALL(rw_scene_occluded(scene, &rays_in[i], NULL, &a->occluded[i]), UNWRITTEN(a->occluded[i]));
    }
    CALL(rw_scene_intersect(scene, &rays_in[0], &skipping, &a->skipping), UNWRITTEN(a->skipping));
    CALL(rw_scene_intersect_all(scene, &rays_in[0], NULL, a->all, MOST, &a->all_count),
         UNWRITTEN(a->all) && UNWRITTEN(a->all_count));
    hits.normal.data = a->normal;
    hits.normal.type = RW_FLOAT64;
    hits.primitive.data = a->primitive;
    CALL(rw_scene_intersect_batch(scene, &rays, &hits, query), UNWRITTEN(a->t) && UNWRITTEN(a->primitive));
    memset(&flags, 0, sizeof flags);
    flags.data = a->flags;
    CALL(rw_scene_occluded_batch(scene, &rays, &flags, query), UNWRITTEN(a->flags));
    all.t.data = a->all_t;
    all.t.type = RW_FLOAT32;
    CALL(rw_scene_intersect_all_batch(scene, &rays, a->offsets, &all, RAYS * MOST, &needed, query),
         needed == 0 && UNWRITTEN(a->offsets) && UNWRITTEN(a->all_t));
    CHECK(needed == a->offsets[RAYS]);
    CALL(rw_scene_bounds(scene, a->lower, a->upper), UNWRITTEN(a->lower));
}

static void ask_view(const rw_scene *scene, const plan *p, const rw_commit_options *one_thread,
                     const rw_query_options *query, answers *a) {
    const rw_rays rays = all_rays();
    const rw_hits hits = only_t(a->view_t);
    rw_view_options options;
    rw_scene *view = NULL;
    uint64_t needed = 0;
    int i;
    memset(&options, 0, sizeof options);
    options.struct_size = sizeof options;
    options.origin[2] = 2.0;
    options.count = 1000000;
    options.structure = p->structure;
    CALL(rw_scene_view(scene, &options, one_thread, &view), view == NULL);
    for (i = 0; i < RAYS; ++i)
        CALL(rw_scene_intersect(view, &rays_in[i], NULL, &a->view_single[i]), UNWRITTEN(a->view_single[i]));
    CALL(rw_scene_intersect_batch(view, &rays, &hits, query), UNWRITTEN(a->view_t));
    CALL(rw_scene_intersect_all_batch(view, &rays, a->view_offsets, NULL, 0, &needed, query),
         UNWRITTEN(a->view_offsets));
    CALL(rw_scene_explain(view, RW_FORMAT_TEXT, NULL, 0, &needed), 1);
    CHECK_OK(rw_scene_release(view));
}

static void ask_why(const rw_scene *scene) {
    char text[16384] = "unchanged";
    rw_candidate candidate;
    rw_scene_statistics statistics;
    uint32_t count = 0, i;
    uint64_t needed = 0;
    candidate.struct_size = sizeof candidate;
    statistics.struct_size = sizeof statistics;
    CALL(rw_scene_candidate_count(scene, &count), 1);
    for (i = 0; i < count; ++i) CALL(rw_scene_get_candidate(scene, i, &candidate), 1);
    CALL(rw_scene_get_statistics(scene, &statistics), 1);
    CALL(rw_scene_explain(scene, RW_FORMAT_JSON, text, sizeof text, &needed), strcmp(text, unchanged_text) == 0);
    CALL(rw_scene_explain(scene, RW_FORMAT_TEXT, text, sizeof text, &needed), text[0] == '{');
}

static void ask_moved(const rw_scene *scene, const rw_commit_options *one_thread, answers *a) {
    rw_scene *moved = NULL;
    rw_triangles meshes[3];
    int i;
    meshes[0] = meshes[1] = meshes[2] = triangles_of(&some);
    meshes[0].vertices.data = moved_vertices;
    meshes[0].indices.data = NULL; /* kept */
    meshes[1].vertex_count = meshes[2].vertex_count = 6;
    meshes[1].vertices.data = meshes[2].vertices.data = wide_vertices;
    meshes[1].vertices.type = meshes[2].vertices.type = RW_FLOAT64;
    meshes[1].triangle_count = meshes[2].triangle_count = 2;
    meshes[1].indices.data = meshes[2].indices.data = NULL;
    meshes[2].flags = RW_TRIANGLES_SKIP_INVALID; /* the indices that were shared are copied now */
    CALL(rw_scene_refit(scene, meshes, 3, one_thread, &moved), moved == NULL);
    for (i = 0; i < RAYS; ++i) CALL(rw_scene_intersect(moved, &rays_in[i], NULL, &a->moved[i]), UNWRITTEN(a->moved[i]));
    CHECK_OK(rw_scene_release(moved));
}

static void ask_once(const rw_profile *profile, const plan *p, const rw_query_options *query, answers *a) {
    const rw_triangles mesh = triangles_of(&some);
    const rw_rays rays = all_rays();
    const rw_hits hits = only_t(a->once_t);
    rw_once_options options;
    memset(&options, 0, sizeof options);
    options.struct_size = sizeof options;
    options.profile = profile;
    options.structure = p->structure;
    options.query = query;
    CALL(rw_once_intersect(&mesh, 1, &rays, &hits, &options), UNWRITTEN(a->once_t));
}

static void program(const plan *p, answers *a) {
    rw_profile *profile = NULL;
    rw_scene *scene = NULL;
    rw_commit_options one_thread;
    rw_query_options query;
    uint64_t needed = 0;
    memset(a, 0, sizeof *a);
    memset(&one_thread, 0, sizeof one_thread);
    memset(&query, 0, sizeof query);
    one_thread.struct_size = sizeof one_thread;
    query.struct_size = sizeof query;
    one_thread.threads = query.threads = 1;
    CALL(rw_profile_load(NULL, &profile), profile == NULL);
    CALL(rw_profile_text(profile, RW_FORMAT_TEXT, a->profile_text, sizeof a->profile_text, &needed),
         UNWRITTEN(a->profile_text));
    CALL(rw_scene_create(profile, &scene), scene == NULL);
    fill(scene);
    build(scene, p, &one_thread);
    ask_scene(scene, &query, a);
    ask_view(scene, p, &one_thread, &query, a);
    ask_why(scene);
    ask_once(profile, p, &query, a);
    ask_moved(scene, &one_thread, a);
    CHECK_OK(rw_scene_release(scene));
    CHECK_OK(rw_profile_release(profile));
}

static void refuse_each(const plan *p, refusal which) {
    static answers reference, repeated;
    long number, refused = 1;
    keep_refusing = which == REFUSE_FROM_ON;
    /* What stays for good, such as the thread's streams and locales, is there after these. */
    program(p, &reference);
    refuse(which, 3);
    program(p, &reference);
    stop_refusing();
    attempts = 0;
    for (number = 0; refused > 0; ++number) {
        const long live = live_allocations();
        const int before = failures;
        refuse(which, number);
        program(p, &repeated);
        refused = stop_refusing();
        CHECK(live_allocations() == live);
        CHECK(memcmp(&reference, &repeated, sizeof reference) == 0);
        if (failures != before) fprintf(stderr, "    allocation %ld of %s refused\n", number, p->structure);
    }
    printf("%s, effort %d, rule %d, %s: %ld allocations, %ld calls out of memory\n",
           p->structure == NULL ? "chosen" : p->structure, (int)p->effort, (int)p->rule,
           which == REFUSE_ONE ? "one refused" : "refused from one on", number - 1, attempts);
    CHECK(attempts > 10 && attempts < number);
}

int main(void) {
    static const plan thoughtful[] = {
        {NULL, RW_EFFORT_ESTIMATE, RW_RULE_SMALLEST_TOTAL},
        {NULL, RW_EFFORT_PROBE, RW_RULE_SMALLEST_TOTAL},
        {NULL, RW_EFFORT_MEASURE, RW_RULE_SMALLEST_TOTAL},
        {NULL, RW_EFFORT_ESTIMATE, RW_RULE_HAPALA},
    };
    static const double quad[18] = {-3, -3, 0.25, 3, -3, 0.25, 3, 3, 0.25, -3, -3, 0.5, 3, 3, 0.5, -3, 3, 0.5};
    uint32_t structures = 0, i;
    use_all_helpers();
    some = make_soup(TRIANGLES);
    memcpy(wide_vertices, quad, sizeof quad);
    for (i = 0; i < 9 * TRIANGLES; ++i) moved_vertices[i] = some.vertices[i] * (i % 3 == 1 ? -0.75f : 1.25f);
    for (i = 0; i < 6; ++i) wide_indices[i] = 5 - i;
    for (i = 0; i < RAYS; ++i) rays_in[i] = random_ray();
    NEED_OK(rw_structure_count(&structures));
    for (i = 0; i < structures; ++i) {
        plan p = {NULL, RW_EFFORT_ESTIMATE, RW_RULE_SMALLEST_TOTAL};
        NEED_OK(rw_structure_name(i, &p.structure));
        refuse_each(&p, REFUSE_ONE);
        refuse_each(&p, REFUSE_FROM_ON);
    }
    for (i = 0; i < sizeof thoughtful / sizeof thoughtful[0]; ++i) {
        refuse_each(&thoughtful[i], REFUSE_ONE);
        refuse_each(&thoughtful[i], REFUSE_FROM_ON);
    }
    free_soup(&some);
    return finish("out of memory");
}
