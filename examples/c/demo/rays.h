/* Lists of rays, laid out as raywise takes them without a copy. */
#ifndef DEMO_RAYS_H
#define DEMO_RAYS_H

#include "api.h"
#include "vector.h"

struct ray_list {
    uint64_t count;
    float *origins; /* 3 per ray; NULL: all start at `origin` */
    struct vector origin;
    float *directions; /* 3 per ray */
    double tmax;       /* of every ray */
};

bool ray_list_reserve(struct ray_list *list, uint64_t count, bool own_origins);
void ray_list_free(struct ray_list *list);

/* `count` rays from `first` on as a batch. The batch points into the list. */
rw_rays ray_list_batch(const struct ray_list *list, uint64_t first, uint64_t count);

/* Chords: each ray runs from one random point of the sphere to another, so all parts of a scene are asked about. */
bool rays_random(struct ray_list *list, struct vector center, double radius, uint64_t count, uint64_t seed);

#endif
