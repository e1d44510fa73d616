#include "contract/sweep_rays.h"

#include "geometry/primitives.h"

#include <cmath>
#include <limits>

namespace raywise::sweep {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Maker = rw_ray (RayMaker::*)();

struct Sort {
    unsigned weight;
    Maker make;
};

constexpr Sort sorts[] = {
    {60, &RayMaker::chord},     {50, &RayMaker::camera},     {8, &RayMaker::from_light},  {6, &RayMaker::along_sun},
    {8, &RayMaker::along_axis}, {6, &RayMaker::at_vertex},   {6, &RayMaker::at_edge},     {6, &RayMaker::on_surface},
    {3, &RayMaker::along_edge}, {3, &RayMaker::far_or_long}, {3, &RayMaker::nearly_axis}, {1, &RayMaker::bad},
};

Vec3 scaled_by_power_of_two(Vec3 v, int exponent) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = std::ldexp(v[axis], exponent);
    return v;
}

} // namespace

rw_ray ray_of(const Vec3& origin, const Vec3& direction) {
    return {{origin.x, origin.y, origin.z}, 0.0, {direction.x, direction.y, direction.z}, infinity};
}
Vec3 origin_of(const rw_ray& ray) { return {ray.origin[0], ray.origin[1], ray.origin[2]}; }
Vec3 direction_of(const rw_ray& ray) { return {ray.direction[0], ray.direction[1], ray.direction[2]}; }

rw_ray rounded_to_float32(const rw_ray& ray) {
    const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    rw_ray result = ray;
    for (int axis = 0; axis < 3; ++axis) {
        result.origin[axis] = rounded(ray.origin[axis]);
        result.direction[axis] = rounded(ray.direction[axis]);
    }
    result.tmin = rounded(ray.tmin);
    result.tmax = rounded(ray.tmax);
    return result;
}

rw_ray RayMaker::ordinary_or_hard() {
    static const unsigned total = [] {
        unsigned sum = 0;
        for (const Sort& sort : sorts) sum += sort.weight;
        return sum;
    }();
    auto rest = static_cast<unsigned>(random_.below(total));
    for (const Sort& sort : sorts) {
        if (rest < sort.weight) {
            rw_ray ray = (this->*sort.make)();
            maybe_limit(ray);
            return ray;
        }
        rest -= sort.weight;
    }
    return chord();
}

// An interval that begins before the origin, or ends or begins somewhere on the way.
void RayMaker::maybe_limit(rw_ray& ray) {
    switch (random_.below(12)) {
        case 0:
            ray.tmin = -infinity;
            break;
        case 1:
            ray.tmax = random_.number(0.0, 2.0);
            break;
        case 2:
            ray.tmin = random_.number(-1.0, 1.0);
            break;
        default:
            break;
    }
}

Vec3 RayMaker::vertex() { return scene_.mesh.vertices[random_.below(scene_.mesh.vertices.size())]; }

Corners RayMaker::triangle() {
    const auto& t = scene_.mesh.triangles[random_.below(scene_.mesh.triangles.size())];
    return {scene_.mesh.vertices[t[0]], scene_.mesh.vertices[t[1]], scene_.mesh.vertices[t[2]]};
}

Vec3 RayMaker::on_an_edge() {
    const Corners c = triangle();
    const std::size_t first = random_.below(3);
    const Vec3& a = c[first];
    const Vec3& b = c[(first + 1) % 3];
    // Quarters are mostly free of rounding; any other part is off the edge by about a rounding.
    const double part = random_.one_in(2) ? 0.25 * static_cast<double>(1 + random_.below(3)) : random_.number(0.0, 1.0);
    return (1.0 - part) * a + part * b;
}

Vec3 RayMaker::on_a_triangle() {
    const Corners c = triangle();
    if (random_.one_in(2)) return 0.25 * c[0] + 0.25 * c[1] + 0.5 * c[2];
    const double u = random_.number(0.0, 1.0);
    const double v = random_.number(0.0, 1.0 - u);
    return (1.0 - u - v) * c[0] + u * c[1] + v * c[2];
}

Vec3 RayMaker::on_sphere() { return scene_.center + scene_.radius * random_.direction(); }

Vec3 RayMaker::exactly_around(const Vec3& p) {
    const int exponent = std::ilogb(scene_.radius) - 6;
    Vec3 offset;
    for (int axis = 0; axis < 3; ++axis)
        offset[axis] = std::ldexp(static_cast<double>(random_.below(257)) - 128.0, exponent);
    if (offset == Vec3(0.0)) offset.x = std::ldexp(1.0, exponent);
    return p + offset;
}

rw_ray RayMaker::towards(const Vec3& target) {
    switch (random_.below(4)) {
        case 0:
            return ray_of(scene_.eye, target - scene_.eye);
        case 1: {
            const Vec3 origin = on_sphere();
            return ray_of(origin, target - origin);
        }
        default: {
            const Vec3 origin = exactly_around(target);
            return ray_of(origin, target - origin);
        }
    }
}

rw_ray RayMaker::chord() {
    const Vec3 origin = on_sphere();
    return ray_of(origin, on_sphere() - origin);
}

rw_ray RayMaker::camera() {
    const Vec3 target = scene_.center + 0.8 * scene_.radius * random_.in_cube();
    return ray_of(scene_.eye, target - scene_.eye);
}

rw_ray RayMaker::from_light() {
    const Vec3 target = scene_.center + 0.8 * scene_.radius * random_.in_cube();
    if (random_.one_in(2)) return ray_of(scene_.light, target - scene_.light);
    rw_ray ray = ray_of(target, scene_.light - target);
    ray.tmax = 1.0;
    return ray;
}

rw_ray RayMaker::along_sun() {
    const Vec3 start = has_triangles() && random_.one_in(3) ? vertex() : on_sphere();
    const double lengths[] = {1.0, -1.0, 2.0, -0.25, 3.0};
    return ray_of(start, lengths[random_.below(5)] * scene_.sun);
}

rw_ray RayMaker::along_axis() {
    const int axis = static_cast<int>(random_.below(3));
    Vec3 direction(random_.one_in(2) ? 0.0 : -0.0);
    direction[axis] = random_.one_in(2) ? 1.0 : -1.0;
    if (random_.one_in(3)) direction[(axis + 1) % 3] = random_.number(-1.0, 1.0);
    Vec3 origin = has_triangles() && random_.one_in(2) ? vertex() : on_sphere();
    if (has_triangles() && random_.one_in(4)) origin[(axis + 2) % 3] = vertex()[(axis + 2) % 3];
    if (random_.one_in(2)) origin[axis] -= 4.0 * scene_.radius * direction[axis];
    return ray_of(origin, direction);
}

rw_ray RayMaker::at_vertex() { return has_triangles() ? towards(vertex()) : chord(); }
rw_ray RayMaker::at_edge() { return has_triangles() ? towards(on_an_edge()) : chord(); }

rw_ray RayMaker::on_surface() {
    if (!has_triangles()) return chord();
    const std::uint64_t where = random_.below(3);
    const Vec3 origin = where == 0 ? vertex() : where == 1 ? on_an_edge() : on_a_triangle();
    return ray_of(origin, random_.one_in(2) ? random_.direction() : exactly_around(origin) - origin);
}

rw_ray RayMaker::along_edge() {
    if (!has_triangles()) return chord();
    const Corners c = triangle();
    const Vec3 edge = c[1] - c[0];
    rw_ray ray = ray_of(c[0], edge);
    switch (random_.below(4)) {
        case 0:
            break;
        case 1:
            ray = ray_of(c[0] - edge, edge);
            break;
        case 2:
            ray = ray_of(c[2] - 2.0 * edge, edge);
            break;
        default:
            ray = ray_of(0.5 * c[1] + 0.5 * c[2], edge + 0x1p-30 * scene_.radius * random_.in_cube());
            break;
    }
    return ray;
}

rw_ray RayMaker::far_or_long() {
    const Vec3 target = has_triangles() ? on_a_triangle() : scene_.center;
    if (random_.one_in(2)) {
        const Vec3 origin =
            scene_.center + std::ldexp(scene_.radius, static_cast<int>(10 + random_.below(20))) * random_.in_cube();
        return ray_of(origin, target - origin);
    }
    const Vec3 origin = on_sphere();
    return ray_of(origin, scaled_by_power_of_two(target - origin, static_cast<int>(random_.below(500)) - 250));
}

rw_ray RayMaker::nearly_axis() {
    const int axis = static_cast<int>(random_.below(3));
    Vec3 direction(0.0);
    direction[axis] = random_.one_in(2) ? 1.0 : -1.0;
    direction[(axis + 1) % 3] = std::ldexp(random_.number(-1.0, 1.0), -static_cast<int>(random_.below(1080)));
    direction[(axis + 2) % 3] = std::ldexp(random_.number(-1.0, 1.0), -static_cast<int>(random_.below(60)));
    rw_ray ray = ray_of(has_triangles() ? on_a_triangle() : on_sphere(), direction);
    if (random_.one_in(2)) ray.origin[axis] -= 2.0 * scene_.radius * direction[axis];
    return ray;
}

rw_ray RayMaker::bad() {
    rw_ray ray = chord();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double wrong = random_.one_in(2) ? nan : random_.one_in(2) ? infinity : -infinity;
    const std::uint64_t axis = random_.below(3);
    switch (random_.below(6)) {
        case 0:
            ray.origin[axis] = wrong;
            break;
        case 1:
            ray.direction[axis] = wrong;
            break;
        case 2:
            ray.tmin = nan;
            break;
        case 3:
            ray.tmax = nan;
            break;
        case 4:
            ray.tmin = 1.0;
            ray.tmax = 0.5;
            break;
        default:
            for (double& component : ray.direction) component = random_.one_in(2) ? 0.0 : -0.0;
            break;
    }
    return ray;
}

rw_ray RayMaker::from_hit(const rw_ray& ray, const rw_hit& hit) {
    const Vec3 point = origin_of(ray) + hit.t * direction_of(ray);
    rw_ray limited = ray;
    const double ends[] = {hit.t, std::nextafter(hit.t, -infinity), std::nextafter(hit.t, infinity)};
    const double end = ends[random_.below(3)];
    switch (random_.below(8)) {
        case 0:
            limited.tmax = end;
            return limited;
        case 1:
            limited.tmin = end;
            return limited;
        case 2:
            limited.tmin = limited.tmax = end;
            return limited;
        case 3:
        case 4: {
            rw_ray shadow = ray_of(point, scene_.light - point);
            shadow.tmax = 1.0;
            return shadow;
        }
        case 5:
            return ray_of(point, random_.one_in(2) ? scene_.sun : -scene_.sun);
        default: {
            // A point of the unit sphere on top of the surface: the cosine distribution.
            const auto& [a, b, c] = scene_.mesh.triangles[hit.primitive];
            const auto& at = scene_.mesh.vertices;
            const Vec3 normal = unit_normal({at[a], at[b], at[c]});
            const Vec3 facing = glm::dot(normal, direction_of(ray)) > 0.0 ? -normal : normal;
            const Vec3 direction = facing + random_.direction();
            return ray_of(point, direction == Vec3(0.0) ? facing : direction);
        }
    }
}

} // namespace raywise::sweep
