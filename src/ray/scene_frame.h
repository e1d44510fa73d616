// The coordinates in which structures keep boxes and rays in float32: around where most triangles are, and scaled by a power of two so that
// all of the scene lies in [-1, 1]^3, where neither large nor tiny coordinates leave the range of float32.
//
// What float32 rounds by is relative to a coordinate there, and so to the distance from where most triangles are: a triangle far off costs
// the others nothing.
#pragma once

#include "base/box.h"
#include "base/vec.h"

#include <cmath>

namespace raywise {

class SceneFrame {
public:
    SceneFrame() = default;
    // center: see choose_center. radius: how far around it most triangles lie. bounds: of the scene, not empty.
    SceneFrame(const Vec3& center, double radius, const Box& bounds) {
        for (int axis = 0; axis < 3; ++axis) center_[axis] = center[axis];
        const double largest =
            max_component(larger(magnitudes(bounds.lower - center), magnitudes(bounds.upper - center)));
        // A scene smaller than 2^-900 stays small in its frame: the scale itself has to be a number.
        const int exponent = largest > 0x1p-900 ? std::ilogb(largest) + 1 : -900;
        scale_ = std::ldexp(1.0, -exponent);
        radius_ = radius;
        near_ = smaller(near_radii * larger(radius * scale_, 0x1p-100), near_radii);
        const bool is_in_range = scale_ >= 0x1p-60 && scale_ <= 0x1p60 && near_ >= 0x1p-60;
        if (center == Vec3(0.0) && is_in_range) float_scale_ = static_cast<float>(scale_);
    }

    // Exact but for the difference, which rounds by 2^-53 of it, and for what is below the normal numbers then.
    Vec3 to_frame(const Vec3& point) const { return (point - center()) * scale_; }

    // A box relative to the center, not scaled; where the differences round, as much wider.
    Box relative(const Box& box) const { return relative(box, center()); }
    static Box relative(const Box& box, const Vec3& center) {
        if (center == Vec3(0.0)) return box;
        Box result{box.lower - center, box.upper - center};
        result.lower -= 0x1p-52 * magnitudes(result.lower);
        result.upper += 0x1p-52 * magnitudes(result.upper);
        return result;
    }

    Vec3 center() const { return {center_[0], center_[1], center_[2]}; }
    const double* center4() const { return center_; } // x y z, and a zero
    double radius() const { return radius_; }         // in the scene's unit; see the constructor
    double scale() const { return scale_; }           // a power of two
    // The same where float32 coordinates get into the frame without leaving float32; elsewhere zero.
    float float_scale() const { return float_scale_; }
    // Rays that start farther from the center than this, in the frame, are moved (ray/traversal_ray.h).
    double near() const { return near_; }

    // Zero on axes where that costs no more than three bits of float32's 24: there float32 coordinates are kept without loss, and boxes are
    // made of them as they are. Elsewhere the median: float32 resolves 0.5 m at a distance of 5,000 km, so boxes of millimetre triangles
    // would all be alike.
    static Vec3 choose_center(const Vec3& median, double radius) {
        Vec3 center(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            if (std::fabs(median[axis]) > 8.0 * radius)
                center[axis] = static_cast<double>(static_cast<float>(median[axis]));
        }
        return center;
    }

private:
    // Around the center, in radii: so far float32's rounding of a ray's start is 2^-20 of the radius.
    static constexpr double near_radii = 16.0;

    double center_[4] = {0.0, 0.0, 0.0, 0.0};
    double radius_ = 0.0;
    double scale_ = 1.0;
    double near_ = near_radii;
    float float_scale_ = 0.0f;
};

} // namespace raywise
