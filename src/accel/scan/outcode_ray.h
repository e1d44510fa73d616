// What a ray asks of a vertex: on which sides of the ray it certainly lies, seen along the ray. A triangle all of whose corners are on one
// side is missed (the outcodes of Cohen and Sutherland, with the ray in place of the window).
//
// A vertex is sheared as for ScanRay, by the ray's numbers: to x + shear_x z - offset_x and the same of y, as three products and their sum,
// two of which are with 0 and 1 and exact. With M the largest coordinate of a vertex, S of the ray's start and u = 2^-24: three sums round
// by u (2 M + 2 S) each, the product with the shear by u M where it is not fused; the vertex itself is rounded by 2 u M, offset_x by 3 u S,
// and that shear_x is rounded moves the vertex by u (M + S). Together less than 11 u (M + S); M is at most 1.
#pragma once

#include "accel/scan/scan_ray.h"

#include <cstddef>

namespace raywise {

struct OutcodeRay {
    float x[3] = {}; // what each coordinate of a vertex counts for its sheared x
    float y[3] = {};
    float offset_x = 0.0f;
    float offset_y = 0.0f;
    float error = 0.0f; // of a sheared coordinate; a vertex beyond it is on that side

    OutcodeRay() = default; // no ray

    // scale: from the vertices' numbers to the ray's frame, a power of two.
    OutcodeRay(const ScanRay& ray, float scale) : offset_x(ray.offset_x), offset_y(ray.offset_y) {
        x[ray.x_axis] = scale;
        y[ray.y_axis] = scale;
        x[ray.z_axis] = -ray.shear_x * scale;
        y[ray.z_axis] = -ray.shear_y * scale;
        // ScanRay's is 8.5 u (M + S), rounded up.
        error = 1.5f * (ScanRay::corner_error + ray.start_error);
    }
};

} // namespace raywise
