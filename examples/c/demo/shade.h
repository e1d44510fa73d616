/* What colour a hit has, with and without the lamp. */
#ifndef DEMO_SHADE_H
#define DEMO_SHADE_H

#include "ask.h"
#include "camera.h"
#include "ground.h"
#include "model.h"

/* Everything that shading looks at. Geometry 0 is the model, geometry 1 the ground. */
struct look {
    const struct model *model;
    const struct ground *ground; /* NULL: there is none */
    const struct stage *stage;
    const struct camera *camera;
    const struct lamp *lamp;
};

struct shade {
    struct vector dark; /* colour in any case, linear RGB */
    struct vector lit;  /* what the lamp adds when nothing is in its way */
    bool asks_lamp;     /* whether that has to be asked */
    float from_lamp[3]; /* the shadow ray's direction; it ends at t = 1 */
};

/* direction: of the camera ray. height: 0 at the picture's top, 1 at its bottom. */
void shade_hit(const struct look *look, const struct surface_hit *found, const float direction[3], double height,
               struct shade *shade);

#endif
