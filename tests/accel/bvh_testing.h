// What the tests of the hierarchies share: scenes, rays, and the comparison with the linear scan, bit by bit.
#pragma once

#include "base/parallel.h"
#include "base/progress.h"
#include "geometry/primitives.h"
#include "oracle/plain_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace raywise::bvh_testing {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Triangles = std::vector<Corners>;

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}

    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
    Vec3 in_cube(double half = 1.0) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
    Vec3 direction() {
        for (;;) {
            const Vec3 v = in_cube();
            const double length2 = glm::dot(v, v);
            if (length2 > 0.01 && length2 <= 1.0) return v / std::sqrt(length2);
        }
    }

private:
    std::mt19937_64 engine_;
};

inline Vec3 through_float(const Vec3& v) { return Vec3(Vec3f(v)); }

// A scene as one mesh, of float32 corners where that loses nothing, and what a structure is built from.
class Scene {
public:
    explicit Scene(const Triangles& triangles, unsigned threads = 1) : parallel_(threads) {
        TriangleArrays arrays;
        std::vector<Vec3f> floats;
        bool is_float32 = true;
        for (const Corners& corners : triangles) {
            for (const Vec3& corner : corners) {
                floats.emplace_back(corner);
                is_float32 = is_float32 && Vec3(floats.back()) == corner;
            }
        }
        if (is_float32) {
            arrays.vertices = {reinterpret_cast<const std::byte*>(floats.data()), 3 * sizeof(float), sizeof(float),
                               Scalar::float32};
        } else {
            arrays.vertices = {reinterpret_cast<const std::byte*>(triangles.data()), 3 * sizeof(double), sizeof(double),
                               Scalar::float64};
        }
        arrays.vertex_count = 3 * triangles.size();
        arrays.triangle_count = triangles.size();
        primitives_ = std::make_unique<Primitives>(
            std::vector<std::shared_ptr<const TriangleMesh>>{std::make_shared<const TriangleMesh>(arrays, true, true)});
    }

    const Primitives& primitives() const { return *primitives_; }
    const Box& bounds() const { return primitives_->bounds(); }
    BuildInput input(std::optional<ViewFrame> view = {}) { return {*primitives_, {}, view, parallel_, progress_}; }

private:
    Parallel parallel_;
    Progress progress_;
    std::unique_ptr<Primitives> primitives_;
};

inline bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

inline bool same_hit(const PrimitiveHit& a, const PrimitiveHit& b) {
    return a.primitive == b.primitive && same_bits(a.t, b.t) && same_bits(a.u, b.u) && same_bits(a.v, b.v);
}

inline std::string text_of(const Ray& ray) {
    char text[400];
    std::snprintf(text, sizeof text, "origin %a %a %a direction %a %a %a t %a ... %a", ray.origin.x, ray.origin.y,
                  ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z, ray.tmin, ray.tmax);
    return text;
}

// Of triangles none of which can be hit.
template <class Structure>
void expect_nothing_to_hit(const Triangles& triangles) {
    Scene scene(triangles);
    const Structure structure(scene.input());
    const Ray ray{Vec3(0.0), 0.0, Vec3(1.0), infinity};
    std::vector<PrimitiveHit> hits;
    structure.all(ray, {}, hits);
    EXPECT_FALSE(structure.closest(ray, {}).is_hit());
    EXPECT_FALSE(structure.any(ray, {}));
    EXPECT_TRUE(hits.empty());
    EXPECT_GT(structure.bytes(), 0u);
}

inline RayF rounded_to_float(const Ray& ray) {
    return {Vec3f(ray.origin), static_cast<float>(ray.tmin), Vec3f(ray.direction), static_cast<float>(ray.tmax)};
}

// A ray of float32 against the linear scan: what it hits is what it hits as one of float64.
template <class Structure>
void expect_same_f32(Scene& scene, const Structure& structure, const RayF& ray) {
    const oracle::PlainScan scan(scene.input());
    const PrimitiveHit expected = scan.closest(widened(ray), {});
    EXPECT_TRUE(same_hit(expected, structure.closest_f32(ray, {}))) << "closest_f32; " << text_of(widened(ray));
    EXPECT_EQ(expected.is_hit(), structure.any_f32(ray, {})) << "any_f32; " << text_of(widened(ray));
}

// Closest, any and all against the linear scan, in both precisions. Returns whether the ray hits something.
template <class Structure>
bool expect_same(Scene& scene, const Structure& structure, const Ray& ray) {
    if (!ray.is_traceable()) return false;
    expect_same_f32(scene, structure, rounded_to_float(ray));
    const oracle::PlainScan scan(scene.input());
    const PrimitiveHit expected = scan.closest(ray, {});
    const PrimitiveHit found = structure.closest(ray, {});
    EXPECT_TRUE(same_hit(expected, found))
        << "closest: expected " << expected.primitive << " at " << expected.t << ", found " << found.primitive << " at "
        << found.t << "; " << text_of(ray);
    EXPECT_EQ(scan.any(ray, {}), structure.any(ray, {})) << "any; " << text_of(ray);
    std::vector<PrimitiveHit> all_expected;
    std::vector<PrimitiveHit> all_found;
    scan.all(ray, {}, all_expected);
    structure.all(ray, {}, all_found);
    std::sort(all_found.begin(), all_found.end()); // they may come in any order
    bool same = all_expected.size() == all_found.size();
    for (std::size_t i = 0; same && i < all_expected.size(); ++i) same = same_hit(all_expected[i], all_found[i]);
    EXPECT_TRUE(same) << "all: expected " << all_expected.size() << " hits, found " << all_found.size() << "; "
                      << text_of(ray);
    return expected.is_hit();
}

// The ray, and the same with intervals that begin or end at its hits, or lie behind its origin.
template <class Structure>
bool expect_same_with_intervals(Scene& scene, const Structure& structure, Ray ray) {
    if (!ray.is_traceable()) return false;
    const bool hit = expect_same(scene, structure, ray);
    std::vector<PrimitiveHit> hits;
    oracle::PlainScan(scene.input()).all(ray, {}, hits);
    if (hits.empty()) return hit;
    const double first = hits.front().t;
    const double last = hits.back().t;
    const auto with = [&](double tmin, double tmax) {
        ray.tmin = tmin;
        ray.tmax = tmax;
        expect_same(scene, structure, ray);
    };
    with(first, last);
    with(first, first);
    with(std::nextafter(first, infinity), last);
    with(first, std::nextafter(last, -infinity));
    with(0.0, std::nextafter(first, -infinity));
    with(0.0, 0.5 * first + 0.5 * last);
    with(-infinity, infinity);
    with(-infinity, 0.0);
    with(-1.0, 1.0);
    return hit;
}

// ---- Scenes.

// Triangles of about `size` in the unit cube, around `center` and scaled about the origin before they are moved.
inline Triangles soup(std::size_t count, double size, unsigned seed, double scale = 1.0,
                      const Vec3& center = Vec3(0.0)) {
    Random random(seed);
    Triangles triangles(count);
    for (Corners& corners : triangles) {
        const Vec3 middle = random.in_cube();
        for (Vec3& corner : corners) corner = center + scale * (middle + random.in_cube(size));
    }
    return triangles;
}

inline void add_quad(Triangles& triangles, const Vec3& p, const Vec3& a, const Vec3& b) {
    triangles.push_back({p, p + a, p + a + b});
    triangles.push_back({p, p + a + b, p + b});
}

// Boxes with corners on whole numbers: every plane and edge is shared.
inline Triangles grid_of_boxes(int n) {
    Triangles triangles;
    for (int x = 0; x < n; ++x) {
        for (int y = 0; y < n; ++y) {
            for (int z = 0; z < n; ++z) {
                const Vec3 p(x, y, z);
                for (int axis = 0; axis < 3; ++axis) {
                    Vec3 a(0.0);
                    Vec3 b(0.0);
                    Vec3 c(0.0);
                    a[axis] = b[(axis + 1) % 3] = c[(axis + 2) % 3] = 1.0;
                    add_quad(triangles, p, a, b);
                    add_quad(triangles, p + c, a, b);
                }
            }
        }
    }
    return triangles;
}

// Squares on a plane across an axis.
inline Triangles flat(int n, int axis, double height) {
    Triangles triangles;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            Vec3 p(0.0);
            Vec3 a(0.0);
            Vec3 b(0.0);
            p[axis] = height;
            p[(axis + 1) % 3] = i;
            p[(axis + 2) % 3] = j;
            a[(axis + 1) % 3] = 1.0;
            b[(axis + 2) % 3] = 1.0;
            add_quad(triangles, p, a, b);
        }
    }
    return triangles;
}

// A bumpy closed surface about the origin, with shared vertices.
inline Triangles ball(int n, double radius, unsigned seed = 1) {
    Random random(seed);
    std::vector<Vec3> points;
    constexpr double pi = 3.14159265358979323846;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j < 2 * n; ++j) {
            const double theta = pi * i / n;
            const double phi = pi * j / n;
            const double r = i == 0 || i == n ? radius : radius * random.uniform(0.95, 1.0);
            points.push_back(r *
                             Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
        }
    }
    const auto at = [&](int i, int j) { return points[static_cast<std::size_t>(i * 2 * n + j % (2 * n))]; };
    Triangles triangles;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < 2 * n; ++j) {
            triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return triangles;
}

// ---- Rays.

inline Ray ray_between(const Vec3& from, const Vec3& to, double tmax = infinity) {
    return {from, 0.0, to - from, tmax};
}

// A point the scene is made of: a corner, on an edge, within a triangle; or within its bounds.
inline Vec3 interesting_point(const Triangles& triangles, const Box& bounds, Random& random) {
    const Corners& c = triangles[static_cast<std::size_t>(random.integer(0, static_cast<int>(triangles.size()) - 1))];
    switch (random.integer(0, 3)) {
        case 0:
            return c[0];
        case 1:
            return 0.5 * c[0] + 0.5 * c[1];
        case 2:
            return 0.25 * c[0] + 0.25 * c[1] + 0.5 * c[2];
        default: {
            Vec3 p;
            for (int axis = 0; axis < 3; ++axis) p[axis] = random.uniform(bounds.lower[axis], bounds.upper[axis]);
            return p;
        }
    }
}

// Chords, rays along the axes, rays between points of the scene, rays from far away.
inline Ray any_ray(const Triangles& triangles, const Box& bounds, Random& random) {
    const double size = max_component(bounds.size());
    const Vec3 target = interesting_point(triangles, bounds, random);
    switch (random.integer(0, 5)) {
        case 0:
            return ray_between(interesting_point(triangles, bounds, random), target);
        case 1: {
            Vec3 direction(0.0);
            const int axis = random.integer(0, 2);
            direction[axis] = random.integer(0, 1) == 0 ? 1.0 : -1.0;
            if (random.integer(0, 1) == 0) direction[(axis + 1) % 3] = -0.0;
            return {target - 3.0 * size * direction, 0.0, direction, infinity};
        }
        case 2:
            return ray_between(target + 1e12 * size * random.direction(), target);
        case 3:
            return {target, 0.0, random.direction(), infinity};
        case 4:
            return {target, -infinity, 1e-3 * random.direction(), infinity};
        default:
            return ray_between(bounds.center() + size * random.direction(), target);
    }
}

} // namespace raywise::bvh_testing
