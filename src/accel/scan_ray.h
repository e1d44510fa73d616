// What the scan's float32 test knows of a ray: five numbers, and how far it may err.
//
// Corners are sheared as in geometry/triangle_test.h, but with the ray's start taken off at once: x - offset_x - shear_x z, where
// offset_x is start_x - shear_x start_z. With L the largest component of the start, at least 1, and u = 2^-24: the corner's x and z
// are rounded by u, the start's by u L, offset_x by 2 u L, the first difference by u (1 + 2 L), the product by u, the last
// difference by u (2 + 2 L); that shear_x is rounded moves the corner by u (1 + L). Together less than 9 u (1 + L). FrameRay's
// corner_error is 16 u (1 + L), with many times the start's own rounding added: e is five eighths of it.
//
// With R the largest |x| or |y| of a sheared corner, an edge x1 y2 - y1 x2 is wrong by at most 4 R e + 2 e^2, and rounded by 4 u R^2,
// fused or not (triangle_filter-inl.h). No |x| or |y| in the scene is above 2 (1 + L) + e: one bound serves all triangles.
#pragma once

#include "accel/frame_ray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace raywise {

struct ScanRay {
    ScanRay() = default; // for arrays that are filled later
    // Of a ray that does not miss the scene.
    explicit ScanRay(const FrameRay& ray)
        : x_axis(static_cast<std::size_t>(ray.x_axis)),
          y_axis(static_cast<std::size_t>(ray.y_axis)),
          z_axis(static_cast<std::size_t>(ray.z_axis)),
          shear_x(ray.shear_x),
          shear_y(ray.shear_y) {
        const auto x = static_cast<double>(ray.origin_x);
        const auto y = static_cast<double>(ray.origin_y);
        const auto z = static_cast<double>(ray.origin_z);
        offset_x = static_cast<float>(x - static_cast<double>(shear_x) * z);
        offset_y = static_cast<float>(y - static_cast<double>(shear_y) * z);
        // Everything a little larger, for the rounding of these lines.
        const double e = 0.626 * static_cast<double>(ray.corner_error);
        const double start = 1.001 * std::max({1.0, std::fabs(x), std::fabs(y), std::fabs(z)});
        const double reach = 2.0 * (1.0 + start) + e;
        // Infinity times a reach of zero would be NaN.
        four_e = std::isfinite(e) ? static_cast<float>(4.0 * e) : 0.0f;
        two_e_e = static_cast<float>(2.0 * e * e);
        scene_error = static_cast<float>(1.001 * (reach * (0x1p-22 * reach + 4.0 * e) + 2.0 * e * e));
    }

    std::size_t x_axis = 0; // as PreparedRay's; z is the major axis
    std::size_t y_axis = 0;
    std::size_t z_axis = 0;
    float shear_x = 0.0f;
    float shear_y = 0.0f;
    float offset_x = 0.0f;
    float offset_y = 0.0f;
    float scene_error = 0.0f; // of any edge; infinite where nothing is known of the ray
    float four_e = 0.0f;      // of an edge of corners within R: R (2^-21 R + four_e) + two_e_e
    float two_e_e = 0.0f;
};

} // namespace raywise
