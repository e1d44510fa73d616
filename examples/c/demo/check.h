/* Answers noted down on the way, to be asked again from a plain scan over all triangles. */
#ifndef DEMO_CHECK_H
#define DEMO_CHECK_H

#include "ask.h"
#include "decision.h"

enum {
    CHECK_MOST = 400
};

struct check {
    uint64_t every; /* one pixel in so many is noted */
    uint32_t hit_count;
    float directions[CHECK_MOST][3];
    struct surface_hit hits[CHECK_MOST];
    uint32_t shadow_count;
    float shadow_directions[CHECK_MOST][3];
    uint8_t occluded[CHECK_MOST];

    uint64_t compared; /* answers */
    uint64_t hits_among_them;
    uint64_t different;
};

/* Asks the noted camera and shadow rays again from `scan`, a scene forced to linear_scan. */
bool check_picture(struct check *check, const struct api *api, const rw_scene *scan, uint32_t threads,
                   struct vector eye, struct vector lamp);

/* Asks some random rays from every structure that was built for the tables; the plain scan's answers are the right
 * ones. */
bool check_structures(struct check *check, const struct api *api, const struct forced_scenes *forced,
                      const struct decision *decision, const struct ray_list *list, uint32_t threads);

#endif
