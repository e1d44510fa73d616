// Rays aimed at the edges and vertices of closed meshes, exactly and by a rounding beside.
#pragma once

#include "contract/sweep_closed_scenes.h"
#include "raywise/raywise.h"

namespace raywise::sweep {

class EdgeRayMaker {
public:
    EdgeRayMaker(const ClosedScene& scene, Random& random) : scene_(scene), random_(random) {}

    // From an inside point at a vertex or a point of an edge, or one unit in the last place beside.
    rw_ray from(const Vec3& inside);
    // The same targets from outside, through the mesh.
    rw_ray from_outside();

    Vec3 vertex();
    // a / 4 * (4 - k) + b / 4 * k, without rounding where the coordinates leave room for it; or any other part.
    Vec3 on_edge();

private:
    Vec3 target();

    const ClosedScene& scene_;
    Random& random_;
};

// A number moved by one unit in its last place, up or down or not at all.
double neighbour(double x, Random& random);

} // namespace raywise::sweep
