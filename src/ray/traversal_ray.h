// A ray in float32, in a SceneFrame, as trees of boxes are traversed with it: one cache line, set up by a few vector instructions
// (traversal_ray-inl.h). It culls: it may err towards visiting, never towards leaving out.
//
// Its parameter s counts scaled t (ray/direction_scale.h) in units of the frame: s = t * RayTime::scale - RayTime::moved. A ray that starts
// farther than SceneFrame::near() from the center is moved along its line to the point nearest to the center, in float64 with one rounding
// of fma, so that it starts near what it is traced in; all others have moved = 0. u is 2^-24.
//
// Planes. The distance of a plane p is p * inverse - offset, with offset = start * inverse moved outwards by 2^-21 of itself: as much as the
// rounding of start, of the product, of the offset and of an unfused product of p may displace the plane, 5 u |start| in sum. That is
// relative to the ray's own start, axis by axis, not to the scene.
//
// Distances. What is left of inverse (2 u), of the last difference (u), and of the ends of the interval (u each) is relative: exit distances
// are moved out by box_slack, 16 u of them, which is more than all of it on both sides.
//
// Hits. A hit's t is the exact one but for an error that depends on its triangle's extent E, 2^-28.6 E, and one relative to the distance
// (ray/cell_ray.h). The first is in the boxes: those of leaves are wider by 2^-26 of their triangles' extent on every side (accel/bvh/write.h), which moves entry
// and exit by at least half as much, as no component of the direction is above 2. The second is nothing against box_slack; where the ray
// was moved it is RayTime::error, 2^-48 of the way.
//
// Directions. A component below 2^-120 is taken for 2^-120; as |s| is at most 2^7 here, that moves a point by less than 2^-113, and boxes are
// wider by 2^-112 at least.
#pragma once

#include "ray/ray.h"
#include "ray/scene_frame.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace raywise {

struct alignas(64) TraversalRay {
    float inverse[3];
    float last; // the s behind which no hit is of use any more
    float entry_offset[3];
    float first; // the s before which none is
    float exit_offset[3];
    std::uint32_t octant; // a bit for each axis on which the ray runs backwards, and enters through the upper plane
    float direction[3];   // of any length
    float unused;

    static constexpr float smallest_direction = 0x1p-120f;
    static constexpr float offset_slack = 0x1p-21f;
    static constexpr float box_slack = 0x1p-20f;
};
static_assert(sizeof(TraversalRay) == 64);

// Between the caller's t and s.
struct RayTime {
    double scale; // s = t * scale - moved
    double moved;
    double error;           // of an s, besides what is relative to it
    double length;          // of the direction, as DirectionScale has it; 0: not a normal number
    double origin_distance; // of the ray's own origin from the center, along any axis, in the scene's unit

    static float clamped(double s) {
        constexpr double most = std::numeric_limits<float>::max();
        return static_cast<float>(larger(smaller(s, most), -most));
    }
    float last(double t) const { return clamped(t * scale - moved + error); }
    float first(double t) const { return clamped(t * scale - moved - error); }
};

enum class RaySetup {
    ready,
    misses,     // certainly beside the scene
    untraceable // can hit nothing
};

// The point of a ray's line that is nearest to the frame's center, in the frame, as far as float64 tells.
struct MovedStart {
    Vec3 start;
    double moved; // along the direction
    double error; // of the start along any axis, besides what is relative to it

    // direction: scaled. origin: nearer than farthest.
    MovedStart(const Vec3& origin, const Vec3& direction, const SceneFrame& frame);
    // In the frame. Farther away the line passes anywhere in the scene.
    static constexpr double farthest = 0x1p60;
};

// Rays that need more than a few vector instructions: moved ones, and those with tiny, huge or infinite numbers.
RaySetup set_up_rare_ray(const Ray& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time);

} // namespace raywise
