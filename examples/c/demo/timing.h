/* How long rays take: several candidates against each other on the same rays. */
#ifndef DEMO_TIMING_H
#define DEMO_TIMING_H

#include "ask.h"

enum {
    TIMING_ROUNDS = 5
};

/* One candidate. Set target and zero the rest; the first two figures are the result. */
struct contestant {
    struct target target;
    double ray_ns;  /* per ray, in batches of the size asked for or as near as the cap allows */
    uint64_t timed; /* rays in such a batch: below the number asked for when that would have taken too long */

    uint64_t repeats; /* batches in a round */
    uint64_t next;    /* where the next batch begins in the list */
    double rounds[TIMING_ROUNDS];
    int round_count;
    double spent;
};

/* Times batches of `count` rays of the list, at most about `cap_seconds` for each contestant. They take turns: a
 * machine that is slower for a while is so for all of them. */
bool timing_race(struct contestant *contestants, uint32_t contestant_count, const struct ray_list *list, uint64_t count,
                 double cap_seconds, const char *title);

#endif
