/* Refused allocations while several threads work. Which call meets the refusal depends on the threads, so only this is asked:
 * no crash, no call that never returns, a status that is right, answers that are right afterwards, and nothing that piles up.
 *
 * The threading library keeps memory of its own for as long as the process lives, and makes its threads when they are first
 * needed. So there is a round in which every attempt is the first of its process, and one within a single process. */
#include "testing.h"

#include "refusing.h"

#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define RAYS 520 /* three blocks, two threads */
#define ALL_RAYS 512
#define TRIANGLES 1100        /* fewer are built in one thread */
#define SECONDS_TO_RETURN 120 /* far beyond what any attempt takes: a call has hung */

static soup some;
static rw_ray rays_in[RAYS];
static rw_hit wanted[RAYS];

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

/* A call that may be refused memory: tried again with all the memory it wants. */
#define CALL(call)                                                 \
    do {                                                           \
        int32_t status = (call);                                   \
        if (status != RW_OK) {                                     \
            CHECK_ERROR(status, RW_ERROR_OUT_OF_MEMORY, "memory"); \
            stop_refusing();                                       \
            status = (call);                                       \
        }                                                          \
        check_that(status == RW_OK, #call, __FILE__, __LINE__);    \
    } while (0)

static void program(const char *structure) {
    static double t[RAYS];
    static uint64_t offsets[ALL_RAYS + 1];
    static uint8_t flags[RAYS];
    const rw_triangles mesh = triangles_of(&some);
    rw_rays rays = all_rays();
    rw_commit_options commit;
    rw_query_options query;
    rw_hits hits;
    rw_output occluded;
    rw_scene *scene = NULL;
    uint64_t needed = 0;
    int i;
    memset(&commit, 0, sizeof commit);
    memset(&query, 0, sizeof query);
    memset(&hits, 0, sizeof hits);
    memset(&occluded, 0, sizeof occluded);
    commit.struct_size = sizeof commit;
    query.struct_size = sizeof query;
    commit.threads = query.threads = 2;
    hits.struct_size = sizeof hits;
    hits.t.data = t;
    hits.t.type = RW_FLOAT64;
    occluded.data = flags;
    CALL(rw_scene_create(NULL, &scene));
    CALL(rw_scene_add_triangles(scene, &mesh, NULL));
    CALL(rw_scene_set_structure(scene, structure));
    CALL(rw_scene_commit(scene, &commit));
    CALL(rw_scene_intersect_batch(scene, &rays, &hits, &query));
    CALL(rw_scene_occluded_batch(scene, &rays, &occluded, &query));
    rays.count = ALL_RAYS; /* as many as tell what a thread without memory does */
    CALL(rw_scene_intersect_all_batch(scene, &rays, offsets, NULL, 0, &needed, &query));
    for (i = 0; i < RAYS; ++i) {
        const int hit = wanted[i].primitive != RW_INVALID_ID;
        if (!CHECK(t[i] == wanted[i].t && flags[i] == hit)) break;
        if (i < ALL_RAYS && !CHECK((offsets[i + 1] > offsets[i]) == hit)) break;
    }
    CHECK_OK(rw_scene_release(scene));
}

/* Tells how many were refused. */
static long attempt(const char *structure, long number) {
    const int before = failures;
    long refused;
    refuse(REFUSE_ONE, number);
    program(structure);
    refused = stop_refusing();
    if (failures != before) fprintf(stderr, "    %s, allocation %ld refused\n", structure, number);
    return refused;
}

/* Exit status: 0: nothing was refused any more; 1: all is well; 2: a check failed. */
static int in_a_process(const char *structure, long number) {
    int end = 0;
    const pid_t child = fork();
    if (child == 0) {
        long refused;
        failures = 0;
        alarm(SECONDS_TO_RETURN);
        refused = attempt(structure, number);
        _exit(failures != 0 ? 2 : refused > 0);
    }
    if (child < 0 || waitpid(child, &end, 0) != child) exit(1);
    if (!CHECK(WIFEXITED(end) && WEXITSTATUS(end) < 2)) {
        fprintf(stderr, "    %s, allocation %ld refused: %s\n", structure, number,
                WIFSIGNALED(end) ? strsignal(WTERMSIG(end)) : "checks failed");
        return 2;
    }
    return WEXITSTATUS(end);
}

/* The threading library gives memory back a little after a call has returned: waits for it. */
static long settled_live_allocations(long hoped_for) {
    const struct timespec a_moment = {0, 2000000};
    int i;
    for (i = 0; i < 500 && live_allocations() > hoped_for; ++i) nanosleep(&a_moment, NULL);
    return live_allocations();
}

static void within_one_process(const char *structure) {
    long number, refused = 1, live, after;
    int round;
    for (round = 0; round < 10; ++round) program(structure);
    live = settled_live_allocations(0);
    for (number = 0; refused > 0 && failures == 0; ++number) refused = attempt(structure, number);
    after = settled_live_allocations(live);
    printf("%s, within one process: %ld allocations; %ld alive before, %ld after\n", structure, number, live, after);
    CHECK(after - live < number / 20); /* not one for each attempt */
}

int main(void) {
    static const char *const structures[] = {"uniform_grid", "kd_tree",    "bvh",
                                             "bvh_quality",  "bvh_morton", "two_level_grid"};
    rw_scene *judge;
    size_t s;
    int i;
    use_all_helpers();
    setvbuf(stdout, NULL, _IOLBF, 0);
    some = make_soup(TRIANGLES);
    for (i = 0; i < RAYS; ++i) rays_in[i] = random_ray();

    /* With one thread, so that the threading library is not there yet when this process is copied. */
    {
        rw_commit_options one_thread;
        const rw_triangles mesh = triangles_of(&some);
        memset(&one_thread, 0, sizeof one_thread);
        one_thread.struct_size = sizeof one_thread;
        one_thread.threads = 1;
        NEED_OK(rw_scene_create(NULL, &judge));
        NEED_OK(rw_scene_add_triangles(judge, &mesh, NULL));
        NEED_OK(rw_scene_set_structure(judge, "linear_scan"));
        NEED_OK(rw_scene_commit(judge, &one_thread));
        for (i = 0; i < RAYS; ++i) NEED_OK(rw_scene_intersect(judge, &rays_in[i], NULL, &wanted[i]));
        NEED_OK(rw_scene_release(judge));
    }

    {
        long number = 0;
        int result = 1;
        while (result == 1) result = in_a_process("bvh", number++);
        printf("bvh, at first: %ld allocations\n", number - 1);
    }
    for (s = 0; s < sizeof structures / sizeof structures[0]; ++s) within_one_process(structures[s]);
    free_soup(&some);
    return finish("out of memory, threads");
}
