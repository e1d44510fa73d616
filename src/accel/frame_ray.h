// A ray in float32, in the coordinates of a SceneFrame, for tests that cull: they may err towards visiting, never towards leaving
// out. What is hit is decided by the one exact test alone.
//
// Its parameter s is counted as PreparedRay counts t, in units of the frame, from a start near the scene: t * scale = start + s.
// A ray that begins farther than 4 from the middle starts where it enters the scene; its own origin would cost all of float32's
// digits. Below, L is the largest component of the start, at least 1, and `far` that of the ray's own origin; u is 2^-24, as much
// as float32 rounds by at most.
//
// A hit lies in the scene, so |s| <= 1 + L there: along the ray's major axis, where |direction| >= 1, no two points are farther
// apart.
//
// Planes of boxes. The distance of a plane p is computed as p * inverse - offset, fused or not, where offset is origin * inverse.
// The rounding of origin, inverse and products acts like a displacement of the plane by at most 4 u L. The entry and exit planes
// are moved apart by `shift`, 2^-20 L, which is four times as much, and by 2^-48 far for the rounding of the start. A component of
// the direction below 2^-60 is taken for 2^-60; along |s| <= 1 + L that moves the ray by less than 2^-57 L, which is covered too.
// What is left is relative: 2 u of the distance, or 2^-22 (1 + L) where it matters, since a distance beyond twice 1 + L stays
// beyond 1 + L.
//
// Distances. `margin`, 2^-18 (1 + L), covers that from both sides, the rounding of the interval's ends, and the few ulps that a
// traversal may drop when it sorts. By PreparedRay::margin, which is added, it covers what a hit's t and the start are rounded by
// when the ray comes from far away. Half of it is taken off the distances of entry planes and added to those of exit planes; the
// other half widens the interval.
//
// Triangles: see triangle_filter-inl.h.
#pragma once

#include "accel/scene_frame.h"
#include "accel/triangle_ray.h"
#include "base/ray.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace raywise {

class FrameRay : public TriangleRay {
public:
    FrameRay(const PreparedRay& ray, const SceneFrame& frame) {
        scale_ = frame.scale();
        Vec3 start = frame.to_frame(ray.origin);
        const double far = max_component(magnitudes(start));
        // Farther away float64 does not tell where the ray meets the scene; nor does infinity.
        if (!(far < 0x1p58)) {
            know_nothing(ray);
            return;
        }
        if (far > 4.0) {
            double near;
            if (!may_hit_box(ray, frame.bounds(), ray.tmax, near)) {
                misses_ = true;
                return;
            }
            start_ = near * scale_;
            start += start_ * ray.direction;
        }
        const double local = larger(1.0, max_component(magnitudes(start)));
        const double shift = 0x1p-20 * local + 0x1p-48 * far;
        margin_ = 0x1p-18 * (1.0 + local) + ray.margin * scale_;
        if (!(margin_ < 0x1p50)) {
            know_nothing(ray);
            return;
        }
        backwards = 0;
        for (int axis = 0; axis < 3; ++axis) {
            inverse[axis] = static_cast<float>(larger(smaller(ray.inverse[axis], 0x1p60), -0x1p60));
            if (std::signbit(inverse[axis])) backwards |= 1u << axis;
            const auto rounded = static_cast<double>(inverse[axis]);
            const double apart = std::copysign(shift, rounded);
            entry_offset[axis] = static_cast<float>((start[axis] + apart) * rounded + 0.5 * margin_);
            exit_offset[axis] = static_cast<float>((start[axis] - apart) * rounded - 0.5 * margin_);
        }
        set_interval(ray.tmin, ray.tmax);

        x_axis = ray.x_axis;
        y_axis = ray.y_axis;
        z_axis = ray.major_axis;
        origin_x = static_cast<float>(at(start, x_axis));
        origin_y = static_cast<float>(at(start, y_axis));
        origin_z = static_cast<float>(at(start, z_axis));
        shear_x = static_cast<float>(ray.shear_x);
        shear_y = static_cast<float>(ray.shear_y);
        inverse_z = inverse[z_axis];
        corner_error = static_cast<float>(0x1p-20 * (1.0 + local) + 0x1p-46 * far);
    }

    // Certainly beside the scene; nothing else is set then.
    bool misses() const { return misses_; }

    // The s beyond which no hit at a t of at most `limit` lies.
    float last(double limit) const { return interval_end(limit, 0.5); }
    float first_for_triangles() const { return first; }
    // More than what a t, as s, and the ends of the interval are off by, together.
    float margin() const { return static_cast<float>(margin_); }

    // The distance of a plane p on an axis: p * inverse - offset.
    alignas(16) float inverse[4]; // the last of each is not used
    alignas(16) float entry_offset[4];
    alignas(16) float exit_offset[4];
    std::uint32_t backwards; // a bit for each axis on which the ray enters through the upper plane
    float first;             // the s before which no hit lies
    float last_of_ray;       // last(tmax)

private:
    static constexpr float unbounded = std::numeric_limits<float>::max();

    void set_interval(double tmin, double tmax) {
        first = interval_end(tmin, -0.5);
        last_of_ray = interval_end(tmax, 0.5);
    }

    // Towards infinity by half the margin, which is more than the rounding to float32.
    float interval_end(double t, double margins) const {
        const double s = (t * scale_ - start_) + margins * margin_;
        constexpr auto most = static_cast<double>(unbounded);
        if (!(s > -most)) return -unbounded; // a NaN too: an interval of t that ends at minus infinity
        return s < most ? static_cast<float>(s) : unbounded;
    }

    // Everything is visited: any plane in the frame is passed at -2^50 or 2^50, while those of absent boxes stay in the wrong order
    // (wide_bvh.h); and no triangle is left out.
    void know_nothing(const PreparedRay& ray) {
        margin_ = std::numeric_limits<double>::infinity();
        backwards = 0;
        for (int axis = 0; axis < 3; ++axis) {
            inverse[axis] = 0x1p-40f;
            entry_offset[axis] = 0x1p50f;
            exit_offset[axis] = -0x1p50f;
        }
        set_interval(ray.tmin, ray.tmax);
        x_axis = 0;
        y_axis = 1;
        z_axis = 2;
        origin_x = origin_y = origin_z = shear_x = shear_y = 0.0f;
        inverse_z = 1.0f;
        corner_error = std::numeric_limits<float>::infinity();
    }

    double scale_;
    double start_ = 0.0;
    double margin_ = 0.0;
    bool misses_ = false;
};

} // namespace raywise
