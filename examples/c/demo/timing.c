#include "timing.h"

#include "progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Rounds of small batches go on for so long, so that the clock's own time does not show. */
#define ROUND_NS 40e6

/* Where timed answers go: the distance and the triangle, what most callers want. */
struct scratch {
    float *t;
    uint32_t *primitive;
    uint8_t *occluded;
};

/* The time of `repeats` batches of `count` rays each, on different rays of the list as far as it reaches. */
static bool run(struct contestant *contestant, const struct ray_list *list, uint64_t count, uint64_t repeats,
                const struct scratch *scratch, double *elapsed) {
    rw_hits hits;
    memset(&hits, 0, sizeof hits);
    hits.struct_size = sizeof hits;
    hits.t.data = scratch->t;
    hits.primitive.data = scratch->primitive;
    const double start = clock_ns();
    for (uint64_t i = 0; i < repeats; ++i) {
        if (contestant->next + count > list->count) contestant->next = 0;
        if (!ask_batch(&contestant->target, list, contestant->next, count, &hits, scratch->occluded)) return false;
        contestant->next += count;
    }
    *elapsed = clock_ns() - start;
    return true;
}

/* Finds out how large a batch fits under the cap. A plain scan of a large mesh may take a millisecond for one ray, a
 * grid a microsecond, so batches grow until they tell something. They also warm the caches and wake the threads. */
static bool feel(struct contestant *contestant, const struct ray_list *list, uint64_t most, double cap,
                 const struct scratch *scratch) {
    uint64_t size = 1;
    double elapsed = 0.0;
    for (;;) {
        if (!run(contestant, list, size, 1, scratch, &elapsed)) return false;
        if (size == most || elapsed > cap / 16.0) break;
        size = size * 8 < most ? size * 8 : most;
    }
    const double one = fmax(elapsed / (double)size, 0.01);
    contestant->timed = most;
    if (one * (double)most > cap) contestant->timed = cap > one ? (uint64_t)(cap / one) : 1;
    if (contestant->timed > most) contestant->timed = most;
    const double batch = one * (double)contestant->timed;
    contestant->repeats = (uint64_t)(fmin(ROUND_NS, cap / TIMING_ROUNDS) / batch);
    if (contestant->repeats < 1) contestant->repeats = 1;
    if (contestant->repeats > 2000) contestant->repeats = 2000;
    contestant->next = 0;
    return true;
}

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* One ray differs from the next, so a round's batches are averaged; a machine stumbles now and then, so the middle
 * one of the rounds counts. */
static double median(double *values, int count) {
    qsort(values, (size_t)count, sizeof *values, by_size);
    return count % 2 == 1 ? values[count / 2] : 0.5 * (values[count / 2 - 1] + values[count / 2]);
}

bool timing_race(struct contestant *contestants, uint32_t contestant_count, const struct ray_list *list, uint64_t count,
                 double cap_seconds, const char *title) {
    const double cap = cap_seconds * 1e9;
    const uint64_t most = count < list->count ? count : list->count;
    if (most == 0) return true;
    struct scratch scratch = {malloc(most * sizeof(float)), malloc(most * sizeof(uint32_t)), malloc(most)};
    bool good = scratch.t != NULL && scratch.primitive != NULL && scratch.occluded != NULL;
    if (!good) fprintf(stderr, "raywise-demo: out of memory for %llu answers\n", (unsigned long long)most);

    struct progress progress;
    progress_begin(&progress, title);
    for (uint32_t i = 0; good && i < contestant_count; ++i) {
        good = feel(&contestants[i], list, most, cap, &scratch);
        progress_update(&progress, (double)(i + 1) / contestant_count / (TIMING_ROUNDS + 1));
    }
    for (int round = 0; good && round < TIMING_ROUNDS; ++round)
        for (uint32_t i = 0; good && i < contestant_count; ++i) {
            struct contestant *contestant = &contestants[i];
            /* Another round only if one like the last ones still fits. */
            if (round > 0 && contestant->spent * (round + 1) / round > cap) continue;
            double elapsed = 0.0;
            good = run(contestant, list, contestant->timed, contestant->repeats, &scratch, &elapsed);
            const double rays = (double)contestant->repeats * (double)contestant->timed;
            contestant->rounds[contestant->round_count++] = elapsed / rays;
            contestant->spent += elapsed;
            const double turns = (double)(round + 1) * contestant_count + i + 1;
            progress_update(&progress, turns / (TIMING_ROUNDS + 1) / contestant_count);
        }
    progress_end(&progress);
    for (uint32_t i = 0; good && i < contestant_count; ++i)
        contestants[i].ray_ns = median(contestants[i].rounds, contestants[i].round_count);
    free(scratch.t);
    free(scratch.primitive);
    free(scratch.occluded);
    return good;
}
