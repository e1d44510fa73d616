/* One way to put a batch to a scene, which may be a view. */
#ifndef DEMO_ASK_H
#define DEMO_ASK_H

#include "rays.h"

struct target {
    const struct api *api;
    const rw_scene *scene;
    bool any_hit; /* whether something is hit, instead of what is hit first */
    uint32_t threads;
};

/* Answers rays [first, first + count) of the list. Closest hits go to `hits`; any-hit answers, 1 or 0, to
 * `occluded`. */
bool ask_batch(const struct target *target, const struct ray_list *list, uint64_t first, uint64_t count,
               const rw_hits *hits, uint8_t *occluded);

/* A hit with the normal of its triangle, which a batch writes where it is asked to. */
struct surface_hit {
    rw_hit hit;
    double normal[3];
};

/* Outputs that fill an array of them, every member but hit.reserved. */
rw_hits ask_whole_hits(struct surface_hit *hits);

#endif
