// What the scan's float32 test knows of a ray: five numbers, and how far it may err. It only sorts out triangles that are certainly missed.
//
// Corners are in the coordinates of a SceneFrame, rounded to float32. They are sheared as in geometry/triangle_test.h, but with the ray's
// start taken off at once: x - offset_x - shear_x z, where offset_x is start_x - shear_x start_z. A ray that starts farther than 4 from the
// center is moved as for traversal (ray/traversal_ray.h).
//
// With M the largest coordinate of a corner, S of the start, and u = 2^-24: the corner's x and z are rounded by u M, offset_x by 3 u S, the
// first difference by u (M + 2 S), the product by u M, the last difference by u (2 M + 2 S); that shear_x is rounded moves the corner by
// u (M + S). Together less than e = 8 u (M + S).
//
// With R the largest |x| or |y| of a sheared corner, an edge x1 y2 - y1 x2 is wrong by at most 4 R e + 2 e^2, and rounded by 4 u R^2, fused
// or not. R is at most 2 (M + S). For all of the scene M is 1: one bound, scene_error, tells nearly all misses. Where the triangles near the
// ray are small against the scene their own M is taken.
#pragma once

#include "ray/exact_ray.h"
#include "ray/scene_frame.h"
#include "ray/traversal_ray.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace raywise {

struct ScanRay {
    std::size_t x_axis; // as ExactRay's; z is the major axis
    std::size_t y_axis;
    std::size_t z_axis;
    float shear_x;
    float shear_y;
    float offset_x;
    float offset_y;
    float scene_error; // of any edge; infinite where nothing is known of the ray
    float start_error; // of a sheared coordinate: start_error + corner_error M
    static constexpr float corner_error = 8.5f * 0x1p-24f;

    static constexpr double farthest = 4.0;

    // Returns false where the ray certainly passes beside the scene.
    bool set(const ExactRay& ray, const SceneFrame& frame) {
        Vec3 start = frame.to_frame(ray.origin);
        const double distance = max_component(magnitudes(start));
        const bool known = distance < MovedStart::farthest;
        double moved_error = 0.0;
        if (known && distance > farthest) {
            const MovedStart moved(ray.origin, ray.direction, frame);
            start = moved.start;
            moved_error = moved.error;
            if (max_component(magnitudes(start)) > 2.0) return false;
        }
        if (!known) start = Vec3(0.0);
        x_axis = static_cast<std::size_t>(ray.x_axis);
        y_axis = static_cast<std::size_t>(ray.y_axis);
        z_axis = static_cast<std::size_t>(ray.major_axis);
        shear_x = static_cast<float>(ray.shear_x);
        shear_y = static_cast<float>(ray.shear_y);
        const double z = at(start, ray.major_axis);
        offset_x = static_cast<float>(at(start, ray.x_axis) - static_cast<double>(shear_x) * z);
        offset_y = static_cast<float>(at(start, ray.y_axis) - static_cast<double>(shear_y) * z);
        // Everything a little larger, for the rounding of these lines.
        // The start's own error is like that of a start farther away.
        const double s = 1.001 * max_component(magnitudes(start)) + 0x1p24 * moved_error;
        start_error = known ? static_cast<float>(static_cast<double>(corner_error) * s) : 0x1p60f;
        const double e = static_cast<double>(corner_error) * (1.0 + s);
        const double reach = 2.0 * (1.0 + s) + e;
        scene_error = known ? static_cast<float>(1.001 * (reach * (0x1p-22 * reach + 4.0 * e) + 2.0 * e * e))
                            : std::numeric_limits<float>::infinity();
        return true;
    }
};

} // namespace raywise
