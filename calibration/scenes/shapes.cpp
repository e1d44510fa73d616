#include "scenes/shapes.h"

#include "scenes/random.h"

#include <algorithm>
#include <cmath>

namespace raywise::workloads {
namespace {

constexpr double pi = 3.14159265358979323846;

// Taylor series on [0, pi/4]: the first term left out is below 1e-13.
double sine(double x) {
    const double s = x * x;
    return x * (1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0 * (1.0 - s / 110.0)))));
}
double cosine(double x) {
    const double s = x * x;
    return 1.0 -
           s / 2.0 * (1.0 - s / 12.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0 * (1.0 - s / 90.0 * (1.0 - s / 132.0)))));
}

// In [0, 1)
double lattice_value(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
    std::uint64_t h = seed;
    for (const std::int64_t c : {x, y, z}) h = Random::mix(h * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(c));
    return static_cast<double>(h >> 11) * 0x1p-53;
}

double blend(double a, double b, double t) { return a + (b - a) * t; }
double smooth(double t) { return t * t * (3.0 - 2.0 * t); }

} // namespace

Vec2 on_circle(double part) {
    part -= std::floor(part);
    const int eighth = static_cast<int>(part * 8.0); // which eighth of the turn
    const double within = part - eighth / 8.0;       // 0 ... 1/8 of a turn
    const bool odd = eighth % 2 != 0;
    const double x = 2.0 * pi * (odd ? 0.125 - within : within);
    double c = odd ? sine(x) : cosine(x); // within the quarter
    double s = odd ? cosine(x) : sine(x);
    switch (eighth / 2) {
        case 1:
            return {-s, c};
        case 2:
            return {-c, -s};
        case 3:
            return {s, -c};
        default:
            return {c, s};
    }
}

Frame::Frame(const Vec3& z_direction) : z(z_direction) {
    // The axis that z is farthest from.
    const Vec3 a = glm::abs(z);
    const Vec3 other = a.x <= a.y && a.x <= a.z ? Vec3(1, 0, 0) : a.y <= a.z ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
    const Vec3 side = glm::cross(other, z);
    x = side / std::sqrt(glm::dot(side, side));
    y = glm::cross(z, x);
}

std::uint32_t add_vertex(Mesh& mesh, const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) mesh.vertices.push_back(static_cast<float>(p[axis]));
    return static_cast<std::uint32_t>(mesh.vertex_count() - 1);
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

void add_box(Mesh& mesh, const Box& box, bool inwards) {
    std::uint32_t corner[8];
    for (unsigned i = 0; i < 8; ++i) {
        corner[i] = add_vertex(mesh, {i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                                      i & 4 ? box.upper.z : box.lower.z});
    }
    constexpr unsigned sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& side : sides) {
        const std::uint32_t a = corner[side[0]], c = corner[side[2]];
        const std::uint32_t b = corner[side[inwards ? 3 : 1]], d = corner[side[inwards ? 1 : 3]];
        add_triangle(mesh, a, b, c);
        add_triangle(mesh, a, c, d);
    }
}

BallShape ball_shape(std::uint64_t wanted) {
    // rings * segments * 2 triangles, with twice as many segments as rings: square-looking patches at the equator.
    const double patches = static_cast<double>(std::max<std::uint64_t>(wanted, 8)) / 2.0;
    const std::uint32_t rings = std::max(1u, static_cast<std::uint32_t>(std::sqrt(patches / 2.0)));
    const std::uint32_t segments = std::max(3u, static_cast<std::uint32_t>(patches / rings));
    return {rings, segments};
}

void connect_ball(Mesh& mesh, std::uint32_t first_vertex, const BallShape& shape) {
    const auto at = [&](std::uint32_t ring, std::uint32_t segment) {
        return first_vertex + 1 + (ring - 1) * shape.segments + segment % shape.segments;
    };
    const std::uint32_t last = first_vertex + 1 + shape.rings * shape.segments;
    for (std::uint32_t s = 0; s < shape.segments; ++s) {
        add_triangle(mesh, first_vertex, at(1, s + 1), at(1, s));
        for (std::uint32_t r = 1; r < shape.rings; ++r) {
            add_triangle(mesh, at(r, s), at(r, s + 1), at(r + 1, s + 1));
            add_triangle(mesh, at(r, s), at(r + 1, s + 1), at(r + 1, s));
        }
        add_triangle(mesh, last, at(shape.rings, s), at(shape.rings, s + 1));
    }
}

std::uint64_t add_sphere(Mesh& mesh, const Vec3& centre, double radius, std::uint64_t wanted) {
    return add_ball(mesh, centre, wanted, [radius](const Vec3&) { return radius; });
}

double noise(const Vec3& p, std::uint64_t seed) {
    const Vec3 floor(std::floor(p.x), std::floor(p.y), std::floor(p.z));
    const auto x = static_cast<std::int64_t>(floor.x), y = static_cast<std::int64_t>(floor.y),
               z = static_cast<std::int64_t>(floor.z);
    const double tx = smooth(p.x - floor.x), ty = smooth(p.y - floor.y), tz = smooth(p.z - floor.z);
    double layers[2];
    for (int k = 0; k < 2; ++k) {
        double rows[2];
        for (int j = 0; j < 2; ++j) {
            rows[j] = blend(lattice_value(x, y + j, z + k, seed), lattice_value(x + 1, y + j, z + k, seed), tx);
        }
        layers[k] = blend(rows[0], rows[1], ty);
    }
    return blend(layers[0], layers[1], tz);
}

double fractal_noise(Vec3 p, int octaves, std::uint64_t seed) {
    double sum = 0.0, strength = 0.5;
    for (int octave = 0; octave < octaves; ++octave, strength *= 0.5) {
        sum += strength * noise(p, seed + static_cast<std::uint64_t>(octave));
        p *= 2.0;
    }
    return sum;
}

} // namespace raywise::workloads
