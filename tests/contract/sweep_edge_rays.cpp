#include "contract/sweep_edge_rays.h"

#include "contract/sweep_rays.h"

#include <cmath>
#include <limits>

namespace raywise::sweep {

double neighbour(double x, Random& random) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    switch (random.below(3)) {
        case 0:
            return std::nextafter(x, -infinity);
        case 1:
            return std::nextafter(x, infinity);
        default:
            return x;
    }
}

namespace {

Vec3 neighbour(const Vec3& p, Random& random) {
    const double x = sweep::neighbour(p.x, random);
    const double y = sweep::neighbour(p.y, random);
    return {x, y, sweep::neighbour(p.z, random)};
}

} // namespace

Vec3 EdgeRayMaker::vertex() { return scene_.mesh.vertices[scene_.edges[random_.below(scene_.edges.size())].first]; }

Vec3 EdgeRayMaker::on_edge() {
    const Edge& edge = scene_.edges[random_.below(scene_.edges.size())];
    const Vec3& a = scene_.mesh.vertices[edge.first];
    const Vec3& b = scene_.mesh.vertices[edge.second];
    const double part = random_.one_in(2) ? 0.25 * static_cast<double>(1 + random_.below(3)) : random_.number(0.0, 1.0);
    return (1.0 - part) * a + part * b;
}

Vec3 EdgeRayMaker::target() {
    const Vec3 point = random_.one_in(3) ? vertex() : on_edge();
    return random_.one_in(4) ? neighbour(point, random_) : point;
}

rw_ray EdgeRayMaker::from(const Vec3& inside) {
    Vec3 direction = target() - inside;
    if (random_.one_in(4)) direction = neighbour(direction, random_);
    if (direction == Vec3(0.0)) direction.x = 1.0; // any direction will do from inside
    return ray_of(inside, direction);
}

// The origin differs from the target by multiples of a power of two, so that the difference is exact wherever there is room for
// it, and by more than the diameter of the mesh.
rw_ray EdgeRayMaker::from_outside() {
    const int exponent = std::ilogb(scene_.radius) - 4;
    Vec3 steps;
    for (int axis = 0; axis < 3; ++axis) steps[axis] = static_cast<double>(random_.below(257)) - 128.0;
    const int far_axis = static_cast<int>(random_.below(3));
    steps[far_axis] = steps[far_axis] < 0.0 ? steps[far_axis] - 64.0 : steps[far_axis] + 64.0;
    Vec3 offset;
    for (int axis = 0; axis < 3; ++axis) offset[axis] = std::ldexp(steps[axis], exponent);
    const Vec3 at = target();
    const Vec3 origin = at + offset;
    return ray_of(origin, at - origin);
}

} // namespace raywise::sweep
