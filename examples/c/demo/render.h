/* The picture: camera rays, then shadow rays, in blocks of rows. */
#ifndef DEMO_RENDER_H
#define DEMO_RENDER_H

#include "ask.h"
#include "check.h"
#include "shade.h"

struct picture {
    uint32_t size;
    uint32_t samples; /* per pixel, as rendered */
    float *sum;       /* 3 per pixel: sum over the samples, linear RGB */
    uint64_t camera_rays;
    double camera_ns;
    uint64_t shadow_rays;
    double shadow_ns;
};

/* camera, lamp: whom to ask. samples: 1 or 4; 0: 4 when the first takes little time.
 * The first sample's answers are noted in `check` at evenly spread pixels. picture_free in any case. */
bool render(struct picture *picture, const struct look *look, const struct target *camera, const struct target *lamp,
            uint32_t samples, struct check *check);
void picture_free(struct picture *picture);

/* Every ray that the camera sends through the pixels' centres, in the order of the picture. */
bool render_camera_rays(const struct look *look, struct ray_list *list);

/* The shadow rays of what the camera rays of `list` hit. */
bool render_shadow_rays(const struct look *look, const struct target *camera, const struct ray_list *list,
                        struct ray_list *shadows);

#endif
