// What culling in float32 needs of an ordinary ray, in one cache line: nearly all rays are ordinary, and for those it is had by a few
// vector instructions from the caller's ray, without preparing it.
//
// It is a FrameRay (frame_ray.h: s, L, `far`, u and what has to be covered are explained there) of a ray that starts within 4 of the
// middle of the scene, on each axis, or was moved to where it enters the scene, and whose origin is not beyond 2^16. So L = 4 serves
// all, and L = 1 those that start in the frame, as rays from surfaces do; the bounds are constants for L = 4 times `bound`, (1 + L) / 5.
//
// What the numbers below are rounded by, for L = 4. As displacements in units of u: the start by 4, start and shift by 4, the offset
// by 4, where exits are had from entries by 4, the plane's product by 1 where it is not fused: 17, and 64 are allowed for. Direction
// and inverse are rounded one after the other, 2 u of a distance, and the last difference is: with distances up to twice 1 + L, 31 u;
// the ends of the interval by 8 u, and PreparedRay's margin is at most 64 u, which comes to 103, and 128 are allowed for, on each
// side. For L = 1 all but PreparedRay's margin, which is below u for a ray that was not moved, is less than `bound` times that.
//
// A sheared corner: the corner is rounded by u / 2, the start by u L / 2, their differences by u each, along z alike; the shear is wrong
// by 4 u, its product with z rounded by u Z and the last difference by u R, where R is the largest sheared coordinate and Z the largest
// |z|. With M the larger of R and Z that is (1 + L) u + 9 u M, and half as much again is allowed for. Distances are wrong by less.
#pragma once

#include "accel/triangle_ray.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace raywise {

struct alignas(64) PlainRay {
    float inverse[3];
    float last; // the s beyond which no hit lies that is still of use
    float entry_offset[3];
    float first;         // the s before which no hit lies
    float start[3];      // in the frame
    float bound;         // times the constants
    float direction[3];  // the largest component in [1, 2)
    std::uint8_t octant; // a bit for each axis on which the ray runs backwards, and enters through the upper plane
    std::uint8_t major_axis;

    static constexpr double reach = 4.0; // L
    static constexpr double farthest = 0x1p16;
    static constexpr int largest_exponent = 100; // of RayUnit, either way; see PreparedRay's margin
    static constexpr float smallest_direction = 0x1p-60f;
    static constexpr float within_frame = 0.4f; // bound for L = 1
    static constexpr float shift = 0x1p-18f;
    static constexpr float half_margin = 0x1p-17f;
    static constexpr float corner_error = 7.5f * 0x1p-24f;
    static constexpr float corner_error_slope = 12.0f * 0x1p-24f; // not times `bound`

    // More than what a t, as s, and the ends of the interval are off by, together.
    float margin() const { return 2.0f * half_margin * bound; }

    // `first` for triangles. Boxes need all of its margin; here, of a ray that was not moved, no more of it than `first` and t are
    // rounded by: rays that leave a surface a little above it have not to be tested against it exactly.
    float first_for_triangles() const {
        return bound < 1.0f ? first + half_margin * bound - (0x1p-22f * std::fabs(first) + 0x1p-30f) : first;
    }

    TriangleRay for_triangles() const {
        const std::size_t z = major_axis;
        const std::size_t x = z == 2 ? 0 : z + 1;
        const std::size_t y = x == 2 ? 0 : x + 1;
        return {static_cast<int>(x),
                static_cast<int>(y),
                static_cast<int>(z),
                start[x],
                start[y],
                start[z],
                direction[x] * inverse[z],
                direction[y] * inverse[z],
                inverse[z],
                corner_error * bound,
                corner_error_slope};
    }

    // The distance of a plane p on an axis is p * inverse - offset. Exit offsets are
    //     entry_offset - bound * (exit_per_inverse * |inverse| + exit_constant).
    static constexpr float exit_per_inverse = 2.0f * shift;
    static constexpr float exit_constant = 2.0f * half_margin;
};
static_assert(sizeof(PlainRay) == 64);

// What it takes to make an s of a t: of the ray's own unit, and where it was moved to.
struct PlainRayPlace {
    double scale; // of the frame
    double start; // s = t * scale - start

    float half_margin; // of the ray

    // The s beyond which no hit at a scaled t of at most `limit` lies.
    float last(double limit) const {
        return static_cast<float>(limit * scale - start + static_cast<double>(half_margin));
    }
    float first(double limit) const {
        return static_cast<float>(limit * scale - start - static_cast<double>(half_margin));
    }
};

enum class PlainRayStatus {
    plain,
    misses, // certainly beside the scene
    odd     // neither: what is known of it has to come from a FrameRay, or it is not traceable
};

} // namespace raywise
