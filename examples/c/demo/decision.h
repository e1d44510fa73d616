/* A choice of the library's, beside what each candidate really takes. */
#ifndef DEMO_DECISION_H
#define DEMO_DECISION_H

#include "build.h"
#include "timing.h"

struct candidate {
    rw_candidate said; /* by the library, before any ray was asked */
    bool applicable;   /* it means something here and was measured */
    bool build_cut;    /* its build took too long and was cancelled */
    double build_ns;   /* by the demo's stopwatch */
    uint64_t bytes;    /* of the structure; 0: not known */
    double ray_ns;     /* measured */
    uint64_t timed;    /* rays in a timed batch, see timing.h */
    double total_ns;   /* build + all rays; extrapolated when fewer rays were timed */
};

struct decision {
    char title[48]; /* "1,000 random rays" */
    uint64_t rays;
    double decide_ns; /* what choosing took */
    uint32_t count;
    uint32_t chosen; /* index of the one that the library took */
    uint32_t best;   /* index of the one that would have been soonest */
    double regret;   /* (choosing + chosen) / best - 1 */
    struct candidate candidates[MOST_STRUCTURES];
};

/* Lets the library choose for `rays` rays of the list's kind, then measures every candidate. */
bool decision_scene(const struct bench *bench, struct forced_scenes *forced, const struct ray_list *list, uint64_t rays,
                    struct decision *decision);

/* The same for a view of a committed scene. `options` without a structure; the view that the library chose goes to
 * `view` and is the caller's to release. */
bool decision_view(const struct bench *bench, const rw_scene *scene, const rw_view_options *options,
                   const struct ray_list *list, const char *title, struct decision *decision, rw_scene **view);

/* Index of a structure's name in a decision, or its count when it is not there. */
uint32_t decision_find(const struct decision *decision, const char *structure);

#endif
