// The rays of the agreement sweep: ordinary ones, and those that are known to go wrong.
#pragma once

#include "contract/sweep_random.h"
#include "contract/sweep_scenes.h"
#include "raywise/raywise.h"

#include <vector>

namespace raywise::sweep {

rw_ray ray_of(const Vec3& origin, const Vec3& direction);
Vec3 origin_of(const rw_ray& ray);
Vec3 direction_of(const rw_ray& ray);

// Makes one ray after the other for a scene; what it makes depends on the scene and the random numbers alone.
class RayMaker {
public:
    RayMaker(const SweepScene& scene, Random& random) : scene_(scene), random_(random) {}

    // A mix of all sorts below.
    rw_ray ordinary_or_hard();
    // From an answer: shadow and diffuse rays from the point hit, and intervals that end or begin at it.
    rw_ray from_hit(const rw_ray& ray, const rw_hit& hit);

    rw_ray chord();       // through two random points of the bounding sphere
    rw_ray camera();      // from the eye
    rw_ray from_light();  // from the light, or towards it
    rw_ray along_sun();   // along the sun, forwards or backwards
    rw_ray along_axis();  // along an axis or in an axis plane, with zeros of both signs
    rw_ray at_vertex();   // exactly at a vertex, as far as float64 can
    rw_ray at_edge();     // at a point of an edge
    rw_ray on_surface();  // starts at a vertex, a point of an edge or of a triangle
    rw_ray along_edge();  // along an edge, in a triangle's plane, or nearly so
    rw_ray far_or_long(); // from far away; with a very long or very short direction
    rw_ray nearly_axis(); // other components down to the smallest numbers there are
    rw_ray bad();         // NaN, infinity, zero direction, inverted interval: a miss

private:
    bool has_triangles() const { return !scene_.mesh.triangles.empty(); }
    Vec3 vertex();
    Corners triangle();
    Vec3 on_an_edge();
    Vec3 on_a_triangle();
    Vec3 on_sphere();
    // An origin that differs from p by multiples of a power of two, so that the difference is exact.
    Vec3 exactly_around(const Vec3& p);
    rw_ray towards(const Vec3& target);
    void maybe_limit(rw_ray& ray);

    const SweepScene& scene_;
    Random& random_;
};

// Rounds all numbers of a ray to float32.
rw_ray rounded_to_float32(const rw_ray& ray);

} // namespace raywise::sweep
