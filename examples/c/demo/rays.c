#include "rays.h"

#include "random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool ray_list_reserve(struct ray_list *list, uint64_t count, bool own_origins) {
    memset(list, 0, sizeof *list);
    list->count = count;
    list->tmax = INFINITY;
    list->directions = malloc((count != 0 ? count : 1) * 3 * sizeof(float));
    list->origins = own_origins ? malloc((count != 0 ? count : 1) * 3 * sizeof(float)) : NULL;
    if (list->directions == NULL || (own_origins && list->origins == NULL)) {
        fprintf(stderr, "raywise-demo: out of memory for %llu rays\n", (unsigned long long)count);
        ray_list_free(list);
        return false;
    }
    return true;
}

void ray_list_free(struct ray_list *list) {
    free(list->origins);
    free(list->directions);
    memset(list, 0, sizeof *list);
}

rw_rays ray_list_batch(const struct ray_list *list, uint64_t first, uint64_t count) {
    rw_rays rays;
    memset(&rays, 0, sizeof rays);
    rays.struct_size = sizeof rays;
    rays.count = count;
    if (list->origins != NULL) {
        rays.origin.data = list->origins + 3 * first;
    } else {
        /* One origin for all: nothing is copied, and the library sees that the rays share it. */
        rays.origin.data = &list->origin;
        rays.origin.stride = RW_REPEAT;
        rays.origin.type = RW_FLOAT64;
    }
    rays.direction.data = list->directions + 3 * first;
    rays.tmax.data = &list->tmax;
    rays.tmax.stride = RW_REPEAT;
    rays.tmax.type = RW_FLOAT64;
    return rays;
}

static struct vector on_sphere(uint64_t *state) {
    /* Archimedes: the height of a random point of a sphere is evenly spread. */
    const double z = 2.0 * random_unit(state) - 1.0;
    const double angle = 2.0 * 3.14159265358979323846 * random_unit(state);
    const double flat = sqrt(1.0 - z * z);
    return (struct vector){flat * cos(angle), flat * sin(angle), z};
}

bool rays_random(struct ray_list *list, struct vector center, double radius, uint64_t count, uint64_t seed) {
    if (!ray_list_reserve(list, count, true)) return false;
    for (uint64_t i = 0; i < count; ++i) {
        const struct vector from = vector_add(center, vector_scale(on_sphere(&seed), radius));
        const struct vector to = vector_add(center, vector_scale(on_sphere(&seed), radius));
        const struct vector direction = vector_subtract(to, from);
        float *o = list->origins + 3 * i;
        float *d = list->directions + 3 * i;
        o[0] = (float)from.x;
        o[1] = (float)from.y;
        o[2] = (float)from.z;
        d[0] = (float)direction.x;
        d[1] = (float)direction.y;
        d[2] = (float)direction.z;
    }
    return true;
}
