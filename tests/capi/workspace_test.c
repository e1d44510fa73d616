/* Workspaces: the same answers, no memory from the system for a batch like the one before, one batch at a time. */
#include "refusing.h"
#include "testing.h"

#define RAYS 20000
#define MOST_HITS (20 * RAYS)

static rw_scene *scene;
static double origins[RAYS][3], directions[RAYS][3];
static float origins_f32[RAYS][3], directions_f32[RAYS][3];

/* What a batch is given and gives. */
typedef struct batch {
    rw_rays rays;
    rw_hits hits;
    rw_output occluded;
    rw_query_options options;
    uint64_t invalid;
    float t[RAYS];
    float normal[RAYS][3];
    uint32_t primitive[RAYS];
    uint8_t flags[RAYS];
    uint64_t offsets[RAYS + 1];
    rw_hits all;
    float all_t[MOST_HITS];
    uint32_t all_primitive[MOST_HITS];
} batch;

static batch *make_batch(int is_float64, rw_batch_workspace *workspace) {
    batch *b = (batch *)calloc(1, sizeof *b);
    if (b == NULL) exit(1);
    b->rays.struct_size = sizeof b->rays;
    b->hits.struct_size = sizeof b->hits;
    b->options.struct_size = sizeof b->options;
    b->rays.count = RAYS;
    b->rays.origin.data = is_float64 ? (const void *)origins : (const void *)origins_f32;
    b->rays.direction.data = is_float64 ? (const void *)directions : (const void *)directions_f32;
    if (is_float64) b->rays.origin.type = b->rays.direction.type = RW_FLOAT64;
    b->hits.t.data = b->t;
    b->hits.normal.data = b->normal;
    b->hits.primitive.data = b->primitive;
    b->occluded.data = b->flags;
    b->all.struct_size = sizeof b->all;
    b->all.t.data = b->all_t;
    b->all.primitive.data = b->all_primitive;
    b->options.threads = 1;
    b->options.invalid_rays = &b->invalid;
    b->options.workspace = workspace;
    return b;
}

static int same_answers(const batch *a, const batch *b) {
    return memcmp(a->t, b->t, sizeof a->t) == 0 && memcmp(a->normal, b->normal, sizeof a->normal) == 0 &&
           memcmp(a->primitive, b->primitive, sizeof a->primitive) == 0 &&
           memcmp(a->flags, b->flags, sizeof a->flags) == 0 && memcmp(a->offsets, b->offsets, sizeof a->offsets) == 0 &&
           memcmp(a->all_t, b->all_t, sizeof a->all_t) == 0 &&
           memcmp(a->all_primitive, b->all_primitive, sizeof a->all_primitive) == 0 && a->invalid == b->invalid;
}

static int32_t ask_all(batch *b) {
    return rw_scene_intersect_all_batch(scene, &b->rays, b->offsets, &b->all, MOST_HITS, NULL, &b->options);
}

static void ask(batch *b) {
    CHECK_OK(rw_scene_intersect_batch(scene, &b->rays, &b->hits, &b->options));
    CHECK_OK(rw_scene_occluded_batch(scene, &b->rays, &b->occluded, &b->options));
    CHECK_OK(ask_all(b));
}

static void answers_are_the_same(void) {
    rw_batch_workspace *workspace = NULL;
    int round;
    NEED_OK(rw_batch_workspace_create(&workspace));
    for (round = 0; round < 6; ++round) { /* of one kind after the other, by one workspace */
        batch *own = make_batch(round % 2, NULL);
        batch *kept = make_batch(round % 2, workspace);
        own->rays.count = kept->rays.count = round < 2 ? 5000 : RAYS;
        kept->options.threads = (uint32_t)(round % 3);
        ask(own);
        ask(kept);
        CHECK(same_answers(own, kept));
        free(own);
        free(kept);
    }
    CHECK_OK(rw_batch_workspace_release(workspace));
}

/* Every allocation is refused: there is none. */
static void no_memory_is_taken(void) {
    int is_float64;
    for (is_float64 = 0; is_float64 < 2; ++is_float64) {
        rw_batch_workspace *workspace = NULL;
        batch *first, *again;
        int32_t status, status_any, status_all;
        long refused;
        NEED_OK(rw_batch_workspace_create(&workspace));
        first = make_batch(is_float64, workspace);
        again = make_batch(is_float64, workspace);
        ask(first);
        ask(first); /* what blocks take is in one piece from the second time on */
        refuse(REFUSE_FROM_ON, 0);
        status = rw_scene_intersect_batch(scene, &again->rays, &again->hits, &again->options);
        status_any = rw_scene_occluded_batch(scene, &again->rays, &again->occluded, &again->options);
        status_all = ask_all(again);
        refused = stop_refusing();
        CHECK_OK(status);
        CHECK_OK(status_any);
        CHECK_OK(status_all);
        CHECK(first->offsets[RAYS] > RAYS);
        CHECK(refused == 0);
        CHECK(same_answers(first, again));
        /* And without a workspace memory is taken, or this test could not fail. */
        again->options.workspace = NULL;
        refuse(REFUSE_FROM_ON, 0);
        status = rw_scene_intersect_batch(scene, &again->rays, &again->hits, &again->options);
        refused = stop_refusing();
        CHECK(status == RW_ERROR_OUT_OF_MEMORY && refused > 0);
        refuse(REFUSE_FROM_ON, 0);
        status_all = ask_all(again);
        refused = stop_refusing();
        CHECK(status_all == RW_ERROR_OUT_OF_MEMORY && refused > 0);
        free(first);
        free(again);
        CHECK_OK(rw_batch_workspace_release(workspace));
    }
}

/* A batch within a batch, the one way in which two are certain to meet. */
typedef struct meeting {
    batch *inner;
    int refusals;
    int unwritten;
} meeting;

static int32_t ask_within(void *user, double fraction, const char *stage) {
    meeting *m = (meeting *)user;
    (void)fraction;
    (void)stage;
    m->inner->t[0] = -7.0f;
    m->inner->flags[0] = 9;
    m->inner->offsets[0] = 9;
    if (CHECK_ERROR(rw_scene_intersect_batch(scene, &m->inner->rays, &m->inner->hits, &m->inner->options),
                    RW_ERROR_IN_USE, "options.workspace|another batch") &&
        CHECK_ERROR(rw_scene_occluded_batch(scene, &m->inner->rays, &m->inner->occluded, &m->inner->options),
                    RW_ERROR_IN_USE, "options.workspace|another batch") &&
        CHECK_ERROR(ask_all(m->inner), RW_ERROR_IN_USE, "options.workspace|another batch"))
        ++m->refusals;
    m->unwritten += m->inner->t[0] == -7.0f && m->inner->flags[0] == 9 && m->inner->offsets[0] == 9;
    return 0;
}

static void one_batch_at_a_time(void) {
    rw_batch_workspace *workspace = NULL;
    batch *outer, *alone;
    meeting m = {NULL, 0, 0};
    NEED_OK(rw_batch_workspace_create(&workspace));
    outer = make_batch(0, workspace);
    alone = make_batch(0, NULL);
    m.inner = make_batch(0, workspace);
    outer->options.progress = ask_within;
    outer->options.progress_user = &m;
    ask(outer);
    ask(alone);
    CHECK(m.refusals >= 2 && m.unwritten == m.refusals);
    CHECK(same_answers(outer, alone));
    ask(m.inner); /* free again */
    CHECK(same_answers(m.inner, alone));
    free(outer);
    free(alone);
    free(m.inner);
    CHECK_OK(rw_batch_workspace_release(workspace));
}

static void arguments(void) {
    rw_batch_workspace *workspace = NULL;
    CHECK_ERROR(rw_batch_workspace_create(NULL), RW_ERROR_INVALID_ARGUMENT, "workspace|NULL");
    CHECK_OK(rw_batch_workspace_release(NULL));
    refuse(REFUSE_FROM_ON, 0);
    CHECK(rw_batch_workspace_create(&workspace) == RW_ERROR_OUT_OF_MEMORY);
    stop_refusing();
    CHECK(workspace == NULL);
}

int main(void) {
    soup s = make_soup(3000);
    int i, axis;
    use_all_helpers();
    scene = make_scene(&s, "bvh");
    for (i = 0; i < RAYS; ++i) {
        const rw_ray ray = random_ray();
        for (axis = 0; axis < 3; ++axis) {
            origins[i][axis] = ray.origin[axis];
            directions[i][axis] = ray.direction[axis];
            origins_f32[i][axis] = (float)ray.origin[axis];
            directions_f32[i][axis] = (float)ray.direction[axis];
        }
    }
    origins[17][1] = directions[300][0] = NAN;
    origins_f32[17][1] = directions_f32[300][0] = NAN;
    answers_are_the_same();
    no_memory_is_taken();
    one_batch_at_a_time();
    arguments();
    CHECK_OK(rw_scene_release(scene));
    free_soup(&s);
    return finish("workspace_test");
}
