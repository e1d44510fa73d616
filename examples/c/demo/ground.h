/* A square for the model to stand on. It is part of the picture's scene only: chords through a sphere around it
 * would mostly miss the model. */
#ifndef DEMO_GROUND_H
#define DEMO_GROUND_H

#include "camera.h"

struct ground {
    rw_triangles triangles; /* shared: the ground outlives the scenes */
    float vertices[4][3];
    uint32_t indices[2][3];
    double fades_from, fades_to; /* distance from the middle at which it turns into background */
    struct vector middle;
};

void ground_place(struct ground *ground, const struct stage *stage);

#endif
