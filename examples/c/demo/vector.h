/* Three doubles, and the little arithmetic that a picture needs. */
#ifndef DEMO_VECTOR_H
#define DEMO_VECTOR_H

#include <math.h>

struct vector {
    double x, y, z;
};

static inline struct vector vector_add(struct vector a, struct vector b) {
    return (struct vector){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline struct vector vector_subtract(struct vector a, struct vector b) {
    return (struct vector){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline struct vector vector_scale(struct vector a, double s) {
    return (struct vector){a.x * s, a.y * s, a.z * s};
}

static inline double vector_dot(struct vector a, struct vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static inline struct vector vector_cross(struct vector a, struct vector b) {
    return (struct vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double vector_length(struct vector a) { return sqrt(vector_dot(a, a)); }

/* The zero vector stays what it is. */
static inline struct vector vector_unit(struct vector a) {
    const double length = vector_length(a);
    return length > 0.0 ? vector_scale(a, 1.0 / length) : a;
}

static inline struct vector vector_mix(struct vector a, struct vector b, double s) {
    return vector_add(vector_scale(a, 1.0 - s), vector_scale(b, s));
}

static inline double clamp01(double value) { return value < 0.0 ? 0.0 : value > 1.0 ? 1.0 : value; }

/* 0 below low, 1 above high, smooth between. */
static inline double smooth_step(double low, double high, double value) {
    const double s = clamp01((value - low) / (high - low));
    return s * s * (3.0 - 2.0 * s);
}

#endif
