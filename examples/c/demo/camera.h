/* A pinhole camera that frames a box, and a lamp beside it. */
#ifndef DEMO_CAMERA_H
#define DEMO_CAMERA_H

#include "model.h"
#include "rays.h"

struct camera {
    struct vector eye;
    struct vector forward; /* unit; the picture's plane is at distance 1 */
    struct vector right;   /* half the picture's width at that distance */
    struct vector down;    /* half its height */
    double half_angle;     /* from forward to a corner, radians */
    uint32_t size;
};

/* A box with what the picture needs to know about it. */
struct stage {
    double lower[3], upper[3];
    struct vector center;
    double radius; /* of the sphere around the box */
    struct vector up;
    double ground;       /* height of the ground, along up */
    struct vector front; /* unit, level: towards the viewer */
    struct vector side;  /* unit, level: to the viewer's right */
};

void stage_set(struct stage *stage, const double lower[3], const double upper[3], const struct model *model);

/* The nearest place on a three-quarter view from which the whole model is in the picture. */
void camera_frame(struct camera *camera, const struct model *model, const struct stage *stage, uint32_t size);

/* Directions through the pixels of `rows` rows from `row` on, 3 floats each. dx, dy: where in a pixel, 0 to 1. */
void camera_directions(const struct camera *camera, uint32_t row, uint32_t rows, double dx, double dy,
                       float *directions);

/* The lamp: a point, and the cone that holds the lit part of the scene. */
struct lamp {
    struct vector point;
    struct vector forward;
    double half_angle;
};

/* reach: radius of what should be lit, around the stage's centre. */
void lamp_place(struct lamp *lamp, const struct stage *stage, double reach);

/* Options for views from the two. */
rw_view_options camera_view(const struct camera *camera, uint64_t rays);
rw_view_options lamp_view(const struct lamp *lamp, uint64_t rays);

#endif
