#include "check.h"

#include "progress.h"

#include <stdio.h>
#include <string.h>

/* A plain scan of a large mesh takes its time: rays go in small groups until this much has passed. */
#define CHECK_NS 3e9
enum {
    GROUP = 8,
    RANDOM_RAYS = 200
};

/* Bits, not values: 0 and -0 would be different answers. */
static bool same_bits(const double *a, const double *b, size_t count) { return memcmp(a, b, count * sizeof *a) == 0; }

static bool same_hit(const struct surface_hit *one, const struct surface_hit *other) {
    const rw_hit *a = &one->hit, *b = &other->hit;
    return same_bits(&a->t, &b->t, 1) && same_bits(&a->u, &b->u, 1) && same_bits(&a->v, &b->v, 1) &&
           same_bits(one->normal, other->normal, 3) && a->instance == b->instance && a->geometry == b->geometry &&
           a->primitive == b->primitive;
}

static void print_hit(const char *who, const struct surface_hit *found) {
    const rw_hit *hit = &found->hit;
    fprintf(stderr, "    %-14s t %a  u %a  v %a  normal %a %a %a  instance %lu geometry %lu primitive %lu\n", who,
            hit->t, hit->u, hit->v, found->normal[0], found->normal[1], found->normal[2], (unsigned long)hit->instance,
            (unsigned long)hit->geometry, (unsigned long)hit->primitive);
}

static void compare(struct check *check, const char *what, uint64_t index, const struct surface_hit *right,
                    const char *who, const struct surface_hit *hit) {
    ++check->compared;
    check->hits_among_them += right->hit.primitive != RW_INVALID_ID;
    if (same_hit(right, hit)) return;
    if (check->different++ < 5) {
        fprintf(stderr, "raywise-demo: WRONG ANSWER to %s %llu\n", what, (unsigned long long)index);
        print_hit("linear_scan", right);
        print_hit(who, hit);
    }
}

bool check_picture(struct check *check, const struct api *api, const rw_scene *scan, uint32_t threads,
                   struct vector eye, struct vector lamp) {
    struct target target = {api, scan, false, threads};
    struct ray_list list;
    memset(&list, 0, sizeof list);
    struct progress progress;
    progress_begin(&progress, "checking the picture");
    double start = clock_ns();
    list.origin = eye;
    list.directions = &check->directions[0][0];
    list.tmax = INFINITY;
    for (uint32_t i = 0; i < check->hit_count && clock_ns() - start < CHECK_NS; i += GROUP) {
        const uint32_t count = check->hit_count - i < GROUP ? check->hit_count - i : GROUP;
        struct surface_hit right[GROUP];
        const rw_hits outputs = ask_whole_hits(right);
        if (!ask_batch(&target, &list, i, count, &outputs, NULL)) return false;
        for (uint32_t k = 0; k < count; ++k)
            compare(check, "camera ray", i + k, &right[k], "picture", &check->hits[i + k]);
        progress_update(&progress, 0.5 * i / check->hit_count);
    }

    target.any_hit = true;
    list.origin = lamp;
    list.directions = &check->shadow_directions[0][0];
    list.tmax = 1.0;
    start = clock_ns();
    for (uint32_t i = 0; i < check->shadow_count && clock_ns() - start < CHECK_NS; i += GROUP) {
        const uint32_t count = check->shadow_count - i < GROUP ? check->shadow_count - i : GROUP;
        uint8_t right[GROUP];
        if (!ask_batch(&target, &list, i, count, NULL, right)) return false;
        for (uint32_t k = 0; k < count; ++k) {
            ++check->compared;
            check->hits_among_them += right[k];
            if (right[k] == check->occluded[i + k]) continue;
            if (check->different++ < 5)
                fprintf(stderr, "raywise-demo: WRONG ANSWER to shadow ray %u: linear_scan %u, picture %u\n",
                        (unsigned)(i + k), (unsigned)right[k], (unsigned)check->occluded[i + k]);
        }
        progress_update(&progress, 0.5 + 0.5 * i / check->shadow_count);
    }
    progress_end(&progress);
    return true;
}

bool check_structures(struct check *check, const struct api *api, const struct forced_scenes *forced,
                      const struct decision *decision, const struct ray_list *list, uint32_t threads) {
    const uint32_t scan = decision_find(decision, "linear_scan");
    if (scan == decision->count || forced->scenes[scan].scene == NULL) {
        fprintf(stderr, "raywise-demo: there is no linear_scan to compare with\n");
        return false;
    }
    const uint64_t most = list->count < RANDOM_RAYS ? list->count : RANDOM_RAYS;
    struct progress progress;
    progress_begin(&progress, "checking the structures");
    const double start = clock_ns();
    for (uint64_t i = 0; i < most && clock_ns() - start < CHECK_NS; i += GROUP) {
        const uint64_t count = most - i < GROUP ? most - i : GROUP;
        struct surface_hit right[GROUP];
        struct target target = {api, forced->scenes[scan].scene, false, threads};
        rw_hits outputs = ask_whole_hits(right);
        if (!ask_batch(&target, list, i, count, &outputs, NULL)) return false;
        for (uint32_t s = 0; s < decision->count; ++s) {
            if (s == scan || forced->scenes[s].scene == NULL) continue;
            struct surface_hit hits[GROUP];
            target.scene = forced->scenes[s].scene;
            outputs = ask_whole_hits(hits);
            if (!ask_batch(&target, list, i, count, &outputs, NULL)) return false;
            for (uint64_t k = 0; k < count; ++k)
                compare(check, "random ray", i + k, &right[k], decision->candidates[s].said.structure, &hits[k]);
        }
        progress_update(&progress, (double)i / (double)most);
    }
    progress_end(&progress);
    return true;
}
