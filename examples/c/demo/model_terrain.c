/* An island: a height field of several octaves of gradient noise (Perlin 1985), folded where it changes sign so that
 * ridges appear, and sunk below the sea towards its edges. One sheet of triangles of much the same size, which suits
 * a grid far better than the sphereflake does. */
#include "model.h"

#include "random.h"

#include <stdio.h>

/* A slope that belongs to a lattice point, times the way from there. */
static double slope(int64_t x, int64_t y, uint64_t octave, double dx, double dy) {
    uint64_t state = (uint64_t)x * UINT64_C(0x8CB92BA72F3D8DD7) + (uint64_t)y * UINT64_C(0xD6E8FEB86659FD93) + octave;
    random_bits(&state);
    const double angle = 6.28318530717958647692 * random_unit(&state);
    return dx * cos(angle) + dy * sin(angle);
}

static double noise(double x, double y, uint64_t octave) {
    const double fx = floor(x), fy = floor(y);
    const int64_t ix = (int64_t)fx, iy = (int64_t)fy;
    const double dx = x - fx, dy = y - fy;
    /* Perlin's later blend: second derivatives are continuous too, or the lattice would show in the shading. */
    const double sx = dx * dx * dx * (dx * (dx * 6.0 - 15.0) + 10.0);
    const double sy = dy * dy * dy * (dy * (dy * 6.0 - 15.0) + 10.0);
    const double low = slope(ix, iy, octave, dx, dy) * (1.0 - sx) + slope(ix + 1, iy, octave, dx - 1.0, dy) * sx;
    const double high =
        slope(ix, iy + 1, octave, dx, dy - 1.0) * (1.0 - sx) + slope(ix + 1, iy + 1, octave, dx - 1.0, dy - 1.0) * sx;
    return low * (1.0 - sy) + high * sy;
}

/* Above the sea when positive. */
static double height(double x, double y) {
    double sum = 0.0;
    double size = 0.24;
    double scale = 1.3;
    double rough = 1.0; /* high ground is rough, valleys are smooth */
    for (uint64_t octave = 0; octave < 9; ++octave) {
        double ridge = 1.0 - 1.4 * fabs(noise(x * scale + 3.7, y * scale + 1.2, octave));
        ridge *= ridge;
        sum += size * rough * ridge;
        rough = clamp01(1.3 * ridge * rough);
        size *= 0.48;
        scale *= 2.07;
    }
    const double coast = sqrt(x * x + y * y) + 0.25 * noise(2.5 * x, 2.5 * y, 20);
    const double land = 1.0 - smooth_step(0.25, 0.95, coast);
    return (sum + 0.06) * land - 0.06;
}

bool model_terrain(struct model *model, uint32_t detail) {
    const uint32_t side = 32u << (detail < 5 ? detail - 1 : 4); /* 512 squares a side: 524,288 triangles */
    const uint32_t points = side + 1;
    if (!model_reserve(model, (uint64_t)points * points, 2ull * side * side)) return false;
    for (uint32_t j = 0; j < points; ++j)
        for (uint32_t i = 0; i < points; ++i) {
            const double x = 2.0 * i / side - 1.0;
            const double y = 2.0 * j / side - 1.0;
            float *at = model->own_vertices + 3 * model->vertex_count++;
            at[0] = (float)x;
            at[1] = (float)y;
            at[2] = (float)height(x, y);
        }
    for (uint32_t j = 0; j < side; ++j)
        for (uint32_t i = 0; i < side; ++i) {
            const uint32_t a = j * points + i, b = a + 1, c = a + points, d = c + 1;
            const uint32_t corners[6] = {a, b, d, a, d, c};
            for (int half = 0; half < 2; ++half) {
                const uint32_t *corner = corners + 3 * half;
                struct vector p[3];
                for (int k = 0; k < 3; ++k) {
                    const float *v = model->own_vertices + 3 * (uint64_t)corner[k];
                    p[k] = (struct vector){v[0], v[1], v[2]};
                    model->own_indices[3 * model->triangle_count + (uint64_t)k] = corner[k];
                }
                const struct vector n =
                    vector_unit(vector_cross(vector_subtract(p[1], p[0]), vector_subtract(p[2], p[0])));
                const uint8_t paint = p[0].z < 0.012 ? 3 : n.z < 0.70 ? 1 : p[0].z > 0.24 && n.z > 0.76 ? 2 : 0;
                model->own_paint[model->triangle_count++] = paint;
            }
        }
    model_finish(model);
    snprintf(model->title, sizeof model->title, "terrain of %u x %u squares", (unsigned)side, (unsigned)side);
    model->up = MODEL_UP_Z;
    model->wants_ground = true; /* the sea */
    model->ground = 0.0;
    model->ground_colour = (struct vector){0.16, 0.30, 0.38};
    model->palette[0] = (struct vector){0.20, 0.29, 0.10}; /* grass */
    model->palette[1] = (struct vector){0.30, 0.26, 0.22}; /* rock */
    model->palette[2] = (struct vector){0.80, 0.82, 0.86}; /* snow */
    model->palette[3] = (struct vector){0.60, 0.52, 0.34}; /* beach */
    return true;
}
