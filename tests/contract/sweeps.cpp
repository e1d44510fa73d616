// Where a sweep says "through a vertex" the ray's line passes through it without any rounding, as long as the vertices are
// multiples of a common power of two and not much larger: origins are then chosen on the same grid, and directions
// are sums and differences of grid points, never divided and never normalised.
#include "contract/sweeps.h"

#include "base/box.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>

namespace raywise::contract {
namespace {

constexpr double huge = std::numeric_limits<double>::max();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Corners {
    Vec3 a, b, c;
};

class Maker {
public:
    Maker(const RayLines& lines, const std::vector<Mesh>& meshes, std::uint64_t factor)
        : lines_(lines), factor_(factor), random_(lines.seed) {
        Box box;
        for (const Mesh& mesh : meshes) {
            for (const auto& triangle : mesh.triangles) {
                if (triangle[0] >= mesh.vertices.size() || triangle[1] >= mesh.vertices.size() ||
                    triangle[2] >= mesh.vertices.size()) {
                    continue;
                }
                const Corners corners{mesh.vertices[triangle[0]], mesh.vertices[triangle[1]],
                                      mesh.vertices[triangle[2]]};
                if (!is_finite(corners.a) || !is_finite(corners.b) || !is_finite(corners.c)) continue;
                triangles_.push_back(corners);
                for (const Vec3& corner : {corners.a, corners.b, corners.c}) box.extend(corner);
            }
        }
        if (box.empty()) box.extend(Vec3(0.0));
        box_ = box;
        center = box.center();
        const double size = max_component(box.size());
        radius = size > 0.0 ? size : 1.0;
    }

    Vec3 center;
    double radius; // the longest side of the bounding box: everything lies closer to the center than that

    // 0: all there are.
    std::uint64_t count() const { return lines_.count * factor_; }
    std::uint64_t factor() const { return factor_; }
    double parameter(std::size_t i) const { return lines_.numbers[i]; }
    Vec3 point_parameter(std::size_t i) const { return {parameter(i), parameter(i + 1), parameter(i + 2)}; }
    const Box& box() const { return box_; }
    const std::vector<Corners>& triangles() const { return triangles_; }

    double number(double low, double high) {
        return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
    }
    int below(int limit) { return static_cast<int>(random_() % static_cast<std::uint64_t>(limit)); }
    Vec3 in_cube() {
        const double x = number(-1.0, 1.0);
        const double y = number(-1.0, 1.0);
        return {x, y, number(-1.0, 1.0)};
    }
    Vec3 in_ball() {
        Vec3 p = in_cube();
        while (glm::dot(p, p) > 1.0) p = in_cube();
        return p;
    }
    Vec3 on_sphere() {
        Vec3 p = in_ball();
        while (glm::dot(p, p) < 0.01) p = in_ball();
        return glm::normalize(p);
    }
    Corners triangle() {
        if (triangles_.empty()) return {center, center, center};
        const Corners& t = triangles_[static_cast<std::size_t>(below(static_cast<int>(triangles_.size())))];
        const int turn = below(3);
        return turn == 0 ? t : turn == 1 ? Corners{t.b, t.c, t.a} : Corners{t.c, t.a, t.b};
    }
    // A multiple of a small power of two, per axis, at least three radii long: from any point of the scene it leads outside.
    // Never in an axis plane, where flat scenes would be seen edge-on.
    Vec3 step_outside() {
        const int exponent = std::ilogb(radius) - 3;
        Vec3 step;
        const int longest = below(3);
        for (int axis = 0; axis < 3; ++axis) {
            const int steps = axis == longest ? 48 + below(17) : 1 + below(64);
            step[axis] = std::ldexp(below(2) == 0 ? steps : -steps, exponent);
        }
        return step;
    }

private:
    const RayLines& lines_;
    std::uint64_t factor_;
    std::mt19937_64 random_;
    std::vector<Corners> triangles_;
    Box box_;
};

using Rays = std::vector<Ray>;

Ray from(const Vec3& origin, const Vec3& direction) { return {origin, 0.0, direction, infinity}; }

bool lies_before(const Vec3& a, const Vec3& b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }
struct ByPosition {
    bool operator()(const Vec3& a, const Vec3& b) const { return lies_before(a, b); }
    bool operator()(const std::pair<Vec3, Vec3>& a, const std::pair<Vec3, Vec3>& b) const {
        return a.first != b.first ? lies_before(a.first, b.first) : lies_before(a.second, b.second);
    }
};

void vertices_from_point(Maker& make, Rays& rays) {
    const Vec3 origin = make.point_parameter(0);
    if (make.count() == 0) {
        std::set<Vec3, ByPosition> vertices;
        for (const Corners& t : make.triangles()) vertices.insert({t.a, t.b, t.c});
        for (const Vec3& vertex : vertices) rays.push_back(from(origin, vertex - origin));
    }
    for (std::uint64_t i = 0; i < make.count(); ++i) rays.push_back(from(origin, make.triangle().a - origin));
}

// Four times the way to a point at a quarter of the edge, so that nothing is divided.
Vec3 to_quarter(const Vec3& origin, const Vec3& a, const Vec3& b, int quarter) {
    return static_cast<double>(4 - quarter) * (a - origin) + static_cast<double>(quarter) * (b - origin);
}

void edges_from_point(Maker& make, Rays& rays) {
    const Vec3 origin = make.point_parameter(0);
    if (make.count() == 0) {
        std::set<std::pair<Vec3, Vec3>, ByPosition> edges;
        for (const Corners& t : make.triangles()) {
            for (const auto& [a, b] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)}) {
                edges.insert(lies_before(a, b) ? std::pair(a, b) : std::pair(b, a));
            }
        }
        for (const auto& [a, b] : edges) rays.push_back(from(origin, to_quarter(origin, a, b, 2)));
    }
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        const Corners t = make.triangle();
        rays.push_back(from(origin, to_quarter(origin, t.a, t.b, 1 + make.below(3))));
    }
}

void near_edges_from_point(Maker& make, Rays& rays) {
    const Vec3 origin = make.point_parameter(0);
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        const Corners t = make.triangle();
        const Vec3 direction = to_quarter(origin, t.a, t.b, make.below(4)) * (1.0 + make.number(-0.5, 0.5));
        rays.push_back(from(origin, direction + 0x1p-51 * max_component(glm::abs(direction)) * make.in_cube()));
    }
}

void vertices_from_outside(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        const Vec3 step = make.step_outside();
        rays.push_back(from(make.triangle().a + step, -step));
    }
}

void edges_from_outside(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        const Vec3 step = make.step_outside();
        const Corners t = make.triangle();
        const double s = 0.25 * (1 + make.below(3));
        rays.push_back(from((t.a + s * (t.b - t.a)) + step, -step));
    }
}

void along_edges(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        const Corners t = make.triangle();
        const Vec3 edge = t.b - t.a;
        const double length = max_component(glm::abs(edge));
        if (!(length > 0.0)) continue;
        // A power of two, so that the way back is exact.
        const double steps = std::ldexp(1.0, std::max(0, std::ilogb(make.radius / length) + 2));
        rays.push_back(from(t.a - steps * edge, edge));
    }
}

void in_plane(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        const Corners t = make.triangle();
        const double p = make.below(9) - 4;
        const double q = p == 0.0 ? 1.0 : make.below(9) - 4;
        const Vec3 direction = p * (t.b - t.a) + q * (t.c - t.a);
        if (direction == Vec3(0.0)) continue;
        // Through a point of the triangle, from before it.
        const Vec3 target = t.a + 0.25 * make.below(5) * (t.b - t.a);
        rays.push_back(from(target - 8.0 * direction, direction));
    }
}

// An even lattice over the side of the bounding box, its border included.
void axis_grid(Maker& make, Rays& rays) {
    const int axis = static_cast<int>(make.parameter(0));
    const Vec3 size = make.box().size();
    // A larger factor makes the lattice finer, so that the rays of the smaller one are among them.
    const auto finer = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(make.factor())));
    const std::uint64_t side = (make.count() / make.factor() - 1) * finer + 1;
    const auto place = [&](int other, std::uint64_t i) {
        if (i + 1 == side) return at(make.box().upper, other);
        const double part = side > 1 ? static_cast<double>(i) / static_cast<double>(side - 1) : 0.5;
        return at(make.box().lower, other) + part * at(size, other);
    };
    for (std::uint64_t i = 0; i < side; ++i) {
        for (std::uint64_t j = 0; j < side; ++j) {
            Vec3 origin;
            origin[(axis + 1) % 3] = place((axis + 1) % 3, i);
            origin[(axis + 2) % 3] = place((axis + 2) % 3, j);
            const double sign = (i + j) % 2 == 0 ? 1.0 : -1.0;
            origin[axis] = at(make.center, axis) - sign * std::ldexp(1.0, std::ilogb(make.radius) + 1);
            Vec3 direction(0.0);
            direction[axis] = sign;
            rays.push_back(from(origin, direction));
        }
    }
}

Vec3 on_triangle(Maker& make, const Corners& t) {
    const int second = make.below(5);
    const int third = make.below(5 - second);
    return t.a + 0.25 * second * (t.b - t.a) + 0.25 * third * (t.c - t.a);
}

void on_surface(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        const Vec3 origin = on_triangle(make, make.triangle());
        rays.push_back(from(origin, make.on_sphere()));
    }
}

void leaving(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        const Corners t = make.triangle();
        const Vec3 normal = glm::cross(t.b - t.a, t.c - t.a);
        const double length = max_component(glm::abs(normal));
        if (!(length > 0.0)) continue;
        // A power of two keeps the normal's bits, and with them the direction exactly perpendicular where it can be.
        Ray ray = from(on_triangle(make, t), normal * std::ldexp(1.0, -std::ilogb(length)));
        ray.tmin = make.parameter(0);
        rays.push_back(ray);
    }
}

// From a little above each vertex back down to it; above means away from the center, as on a convex mesh.
void back_to_vertices(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        const Vec3 vertex = make.triangle().a;
        const Vec3 up = make.parameter(0) * glm::normalize(vertex - make.center);
        rays.push_back(from(vertex + up, vertex - (vertex + up)));
    }
}

void random_chords(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        const Vec3 origin = make.center + make.radius * make.in_cube();
        rays.push_back(from(origin, make.center + make.radius * make.in_cube() - origin));
    }
}

void from_ball(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        const Vec3 origin = make.center + make.parameter(0) * make.in_ball();
        rays.push_back(from(origin, make.on_sphere()));
    }
}

// One direction for all, neither along an axis nor a diagonal.
const Vec3 point_direction(0.3125, 0.453125, 0.8359375);

void points_in_ball(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        rays.push_back(from(make.center + make.parameter(0) * make.in_ball(), point_direction));
    }
}

void points_beyond_ball(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        Vec3 p = 2.0 * make.in_cube();
        while (glm::dot(p, p) <= 1.0) p = 2.0 * make.in_cube();
        rays.push_back(from(make.center + make.parameter(0) * p, point_direction));
    }
}

void cone(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        rays.push_back(from(make.point_parameter(0), make.point_parameter(3) + make.parameter(6) * make.in_cube()));
    }
}

void from_afar(Maker& make, Rays& rays) {
    for (std::uint64_t i = 0; i < make.count(); ++i) {
        const Vec3 away = make.parameter(0) * make.radius * make.on_sphere();
        const Vec3 target = make.center + make.parameter(1) * make.radius * make.in_ball();
        rays.push_back(from(target + away, target - (target + away)));
    }
}

struct Row {
    SweepKind kind;
    void (*make)(Maker& make, Rays& rays);
};

const std::vector<Row>& rows() {
    const Parameter x{"x", -huge, huge, false}, y{"y", -huge, huge, false}, z{"z", -huge, huge, false};
    const Parameter dx{"dx", -huge, huge, false}, dy{"dy", -huge, huge, false}, dz{"dz", -huge, huge, false};
    const Parameter ball{"radius", 0, huge, false};
    static const std::vector<Row> all = {
        {{"vertices-from-point", {x, y, z}, true}, vertices_from_point},
        {{"edges-from-point", {x, y, z}, true}, edges_from_point},
        {{"near-edges-from-point", {x, y, z}, false}, near_edges_from_point},
        {{"vertices-from-outside", {}, false}, vertices_from_outside},
        {{"edges-from-outside", {}, false}, edges_from_outside},
        {{"along-edges", {}, false}, along_edges},
        {{"in-plane", {}, false}, in_plane},
        {{"axis-grid", {{"axis", 0, 2, true}}, false}, axis_grid},
        {{"on-surface", {}, false}, on_surface},
        {{"leaving", {{"tmin", 0, huge, false}}, false}, leaving},
        {{"back-to-vertices", {{"distance", 0, huge, false}}, false}, back_to_vertices},
        {{"random", {}, false}, random_chords},
        {{"from-ball", {ball}, false}, from_ball},
        {{"points-in-ball", {ball}, false}, points_in_ball},
        {{"points-beyond-ball", {ball}, false}, points_beyond_ball},
        {{"cone", {x, y, z, dx, dy, dz, {"spread", 0, huge, false}}, false}, cone},
        {{"from-afar", {{"distance", 0, huge, false}, {"aim", 0, 1, false}}, false}, from_afar},
    };
    return all;
}

} // namespace

const std::vector<SweepKind>& sweep_kinds() {
    static const std::vector<SweepKind> kinds = [] {
        std::vector<SweepKind> all;
        for (const Row& row : rows()) all.push_back(row.kind);
        return all;
    }();
    return kinds;
}

const SweepKind* sweep_kind_named(const std::string& name) {
    const auto& kinds = sweep_kinds();
    const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const SweepKind& k) { return k.name == name; });
    return found == kinds.end() ? nullptr : &*found;
}

std::vector<Ray> sweep_rays(const RayLines& lines, const std::vector<Mesh>& meshes, bool float32,
                            std::uint64_t factor) {
    Maker make(lines, meshes, factor);
    std::vector<Ray> rays;
    for (const Row& row : rows()) {
        if (row.kind.name == lines.sweep) row.make(make, rays);
    }
    if (!float32) return rays;
    for (Ray& ray : rays) {
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = static_cast<double>(static_cast<float>(ray.origin[axis]));
            ray.direction[axis] = static_cast<double>(static_cast<float>(ray.direction[axis]));
        }
        ray.tmin = static_cast<double>(static_cast<float>(ray.tmin));
        ray.tmax = static_cast<double>(static_cast<float>(ray.tmax));
    }
    return rays;
}

} // namespace raywise::contract
