// The coordinates in which structures keep a scene in float32: moved and scaled so that all of it lies in [-1, 1]^3.
//
// There one bound on rounding serves all scenes, and neither large nor tiny coordinates leave the range of float32.
#pragma once

#include "base/box.h"
#include "base/vec.h"

#include <cmath>

namespace raywise {

class SceneFrame {
public:
    SceneFrame() = default;
    // bounds: of the scene, not empty.
    explicit SceneFrame(const Box& bounds) : bounds_(bounds) {
        const Vec3 center = choose_center(bounds);
        for (int axis = 0; axis < 3; ++axis) center_[axis] = center[axis];
        const double largest =
            max_component(larger(magnitudes(bounds.lower - center), magnitudes(bounds.upper - center)));
        // A scene smaller than 2^-900 stays small in its frame: the scale itself has to be a number.
        const int exponent = largest > 0x1p-900 ? std::ilogb(largest) + 1 : -900;
        scale_ = std::ldexp(1.0, -exponent);
        inverse_scale_ = std::ldexp(1.0, exponent);
    }

    // Exact but for the difference, which rounds by 2^-53 of it, and for what is below the normal numbers then.
    Vec3 to_frame(const Vec3& point) const { return (point - center()) * scale_; }
    Vec3 from_frame(const Vec3& point) const { return point * inverse_scale_ + center(); }

    double scale() const { return scale_; }           // a power of two
    const double* center4() const { return center_; } // x y z, and a zero
    const Box& bounds() const { return bounds_; }     // of the scene, in its own coordinates

    // On each axis zero where that costs no more than three bits of float32's 24: there float32 coordinates are kept without loss.
    // Elsewhere the middle of the scene: float32 resolves 0.5 m at a distance of 5,000 km, so millimetre triangles that are kept in
    // float64 would all be alike. The middle is a float32 itself, so that its differences with float32 coordinates, which are near it,
    // are too.
    static Vec3 choose_center(const Box& bounds) {
        const double size = max_component(bounds.size());
        Vec3 center(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            const double middle = 0.5 * bounds.lower[axis] + 0.5 * bounds.upper[axis];
            if (std::fabs(middle) > 8.0 * size) center[axis] = static_cast<double>(static_cast<float>(middle));
        }
        return center;
    }

private:
    Vec3 center() const { return {center_[0], center_[1], center_[2]}; }

    Box bounds_;
    double center_[4] = {0.0, 0.0, 0.0, 0.0};
    double scale_ = 1.0;
    double inverse_scale_ = 1.0;
};

} // namespace raywise
