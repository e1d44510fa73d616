// What the tests of the grid and the kd-tree share: scenes that are hard for structures that divide space, rays that
// are hard for such scenes, and the one question that matters: are the answers those of the linear scan, bit for bit?
#pragma once

#include "base/parallel.h"
#include "base/progress.h"
#include "geometry/primitives.h"
#include "oracle/plain_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace raywise::grid_kd_testing {

using Soup = std::vector<Corners>;

constexpr double unbounded = std::numeric_limits<double>::infinity();

class Dice {
public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double between(double a, double b) { return a + (b - a) * std::generate_canonical<double, 53>(engine_); }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(between(0.0, static_cast<double>(n))) % n; }
    Vec3 in(const Box& box) {
        return {between(box.lower.x, box.upper.x), between(box.lower.y, box.upper.y),
                between(box.lower.z, box.upper.z)};
    }
    Vec3 unit() {
        for (;;) {
            const Vec3 v = in({Vec3(-1.0), Vec3(1.0)});
            const double squared = glm::dot(v, v);
            if (squared > 0.001 && squared < 1.0) return v / std::sqrt(squared);
        }
    }

private:
    std::mt19937_64 engine_;
};

// A scene of float64 triangles, with all that a build asks for.
class World {
public:
    explicit World(const Soup& soup, unsigned threads = 2, Progress::Callback callback = {})
        : soup_(soup), parallel_(threads), progress_(std::move(callback)) {
        TriangleArrays arrays;
        arrays.vertices = {reinterpret_cast<const std::byte*>(soup_.data()), sizeof(Vec3), sizeof(double),
                           Scalar::float64};
        arrays.vertex_count = 3 * soup_.size();
        arrays.triangle_count = soup_.size();
        primitives_ = std::make_unique<Primitives>(std::vector<std::shared_ptr<const TriangleMesh>>{
            std::make_shared<const TriangleMesh>(arrays, false, true)});
    }
    World(const World&) = delete;

    const Primitives& primitives() const { return *primitives_; }
    const Box& bounds() const { return primitives_->bounds(); }
    const Soup& soup() const { return soup_; }
    BuildInput input() { return {*primitives_, costs, {}, parallel_, progress_}; }

    BuildCosts costs;

private:
    Soup soup_;
    Parallel parallel_;
    Progress progress_;
    std::unique_ptr<Primitives> primitives_;
};

// ---- the comparison ----

inline bool bits_equal(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
inline bool bits_equal(const PrimitiveHit& a, const PrimitiveHit& b) {
    return bits_equal(a.t, b.t) && bits_equal(a.u, b.u) && bits_equal(a.v, b.v) && a.primitive == b.primitive;
}

inline std::string describe(const Ray& ray) {
    std::ostringstream text;
    text << std::hexfloat << "origin (" << ray.origin.x << ", " << ray.origin.y << ", " << ray.origin.z
         << ") direction (" << ray.direction.x << ", " << ray.direction.y << ", " << ray.direction.z << ") from "
         << ray.tmin << " to " << ray.tmax;
    return text.str();
}

// Asks all three questions. The hits of the whole ray go to `hits`.
template <class Structure>
void compare(World& world, const Structure& structure, const Ray& ray, std::vector<PrimitiveHit>& hits) {
    hits.clear();
    if (!ray.is_traceable()) return;
    const oracle::PlainScan judge(world.input());
    EXPECT_TRUE(bits_equal(judge.closest(ray, {}), structure.closest(ray, {})))
        << "closest: " << judge.closest(ray, {}).primitive << " became " << structure.closest(ray, {}).primitive << "; "
        << describe(ray);
    EXPECT_EQ(judge.any(ray, {}), structure.any(ray, {})) << "any: " << describe(ray);
    std::vector<PrimitiveHit> found;
    judge.all(ray, {}, hits);
    structure.all(ray, {}, found);
    bool same = hits.size() == found.size();
    for (std::size_t i = 0; same && i < hits.size(); ++i) same = bits_equal(hits[i], found[i]);
    EXPECT_TRUE(same) << "all: " << hits.size() << " hits became " << found.size() << "; " << describe(ray);
}

// The ray, and parts of it that begin and end at, just before and just after its hits.
template <class Structure>
std::size_t compare_with_windows(World& world, const Structure& structure, const Ray& ray) {
    std::vector<PrimitiveHit> hits;
    std::vector<PrimitiveHit> ignored;
    compare(world, structure, ray, hits);
    if (hits.empty()) return 0;
    const double a = hits.front().t;
    const double b = hits.back().t;
    const double windows[][2] = {{a, b},
                                 {a, a},
                                 {b, b},
                                 {std::nextafter(a, unbounded), unbounded},
                                 {-unbounded, std::nextafter(b, -unbounded)},
                                 {-unbounded, unbounded},
                                 {-unbounded, -0.0},
                                 {a - 1.0, a},
                                 {0.5 * (a + b), b}};
    for (const auto& window : windows) {
        Ray part = ray;
        part.tmin = window[0];
        part.tmax = window[1];
        compare(world, structure, part, ignored);
    }
    return hits.size();
}

// ---- rays ----

// All sorts of rays for the scene; `count` of each sort.
inline std::vector<Ray> hard_rays(const World& world, std::size_t count, std::uint64_t seed) {
    std::vector<Ray> rays;
    if (world.primitives().hittable_count() == 0) {
        rays.push_back({{0, 0, 0}, -unbounded, {1, 0, 0}, unbounded});
        return rays;
    }
    Dice dice(seed);
    const Box& bounds = world.bounds();
    const Vec3 size = bounds.size();
    const double reach = max_component(size);
    const auto add = [&](const Vec3& origin, const Vec3& direction) {
        rays.push_back({origin, 0.0, direction, unbounded});
    };
    const auto corner = [&] { return world.soup()[dice.below(world.soup().size())][dice.below(3)]; };
    // A corner, the middle of an edge, or a place on a face, of some triangle.
    const auto on_surface = [&] {
        const Corners& c = world.soup()[dice.below(world.soup().size())];
        switch (dice.below(3)) {
            case 0:
                return c[dice.below(3)];
            case 1:
                return 0.5 * c[0] + 0.5 * c[1];
            default:
                return 0.25 * c[0] + 0.25 * c[1] + 0.5 * c[2];
        }
    };
    for (std::size_t i = 0; i < count; ++i) {
        // Through the scene, from outside and from inside.
        const Vec3 outside = bounds.center() + 1.5 * reach * dice.unit();
        add(outside, dice.in(bounds)-outside);
        add(outside, on_surface() - outside);
        add(dice.in(bounds), dice.unit());
        // From the surface, to the surface, not of unit length.
        const Vec3 p = on_surface();
        add(p, on_surface() - p);
        add(p, 1e-3 * dice.unit());
        add(p, 1e20 * dice.unit());
        // Along an axis, and along it but for next to nothing, through what is hit or exactly along it.
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 direction(0.0);
            direction[axis] = dice.below(2) == 0 ? 1.0 : -1.0;
            const Vec3 target = on_surface();
            add(target - 2.0 * reach * direction, direction);
            add(target, direction);
            for (const double little : {-0.0, 1e-3, -1e-12, 1e-25, -1e-200}) {
                Vec3 skewed = direction;
                skewed[(axis + 1) % 3] = little;
                skewed[(axis + 2) % 3] = dice.below(2) == 0 ? little : -0.0;
                add(target - 2.0 * reach * direction, skewed);
                add(target - 0.25 * reach * direction, skewed);
            }
            // In a plane of the scene's box.
            Vec3 in_face = dice.in(bounds);
            in_face[(axis + 1) % 3] = dice.below(2) == 0 ? bounds.lower[(axis + 1) % 3] : bounds.upper[(axis + 1) % 3];
            add(in_face, direction);
            // On the planes of an even division, where cells meet.
            Vec3 on_division = bounds.lower;
            for (int a = 0; a < 3; ++a) on_division[a] += size[a] * static_cast<double>(dice.below(17)) / 16.0;
            add(on_division - reach * direction, direction);
            Vec3 diagonal = size;
            if (dice.below(2) == 0) diagonal[axis] = -diagonal[axis];
            add(on_division, diagonal);
            add(bounds.center() - diagonal, diagonal);
        }
        // Through two corners, along edges.
        const Vec3 a = corner();
        add(a - 3.0 * (corner() - a), corner() - a);
        const Corners& some = world.soup()[dice.below(world.soup().size())];
        add(some[0] - 2.0 * (some[1] - some[0]), some[1] - some[0]);
        // From far away, exactly at something.
        for (const double far : {1e3, 1e6, 1e9, 1e12, 1e15}) {
            const Vec3 origin = bounds.center() + far * reach * dice.unit();
            add(origin, on_surface() - origin);
            Vec3 along(0.0);
            const int axis = static_cast<int>(dice.below(3));
            along[axis] = 1.0;
            add(on_surface() - far * reach * along, along);
        }
    }
    return rays;
}

template <class Structure>
void expect_scan_answers(World& world, const Structure& structure, std::uint64_t seed) {
    std::size_t hits = 0;
    const std::size_t rays_of_each_sort = world.soup().size() < 600 ? 3 : 1;
    const std::vector<Ray> rays = hard_rays(world, rays_of_each_sort, seed);
    // The judge tests every primitive: fewer rays where there are many.
    const std::size_t step = 1 + world.soup().size() / 1500;
    for (std::size_t i = seed % step; i < rays.size(); i += step) {
        if (i % 3 == 0) {
            hits += compare_with_windows(world, structure, rays[i]);
        } else {
            std::vector<PrimitiveHit> found;
            compare(world, structure, rays[i], found);
            hits += found.size();
        }
        if (::testing::Test::HasFailure()) return; // one is enough to look at
    }
    if (world.primitives().hittable_count() > 0) {
        EXPECT_GT(hits, 0u);
    }
}

// ---- scenes ----

struct NamedSoup {
    std::string name;
    std::function<Soup()> make;
};

inline void PrintTo(const NamedSoup& scene, std::ostream* out) { *out << scene.name; }

inline Soup random_soup(std::size_t count, double triangle_size, std::uint64_t seed) {
    Dice dice(seed);
    Soup soup;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 center = dice.in({Vec3(0.0), Vec3(1.0)});
        soup.push_back({center + triangle_size * dice.unit(), center + triangle_size * dice.unit(),
                        center + triangle_size * dice.unit()});
    }
    return soup;
}

// Direction components so small that they have no inverse, or one that overflows times anything.
template <class Structure>
void expect_scan_answers_next_to_axes() {
    World world(random_soup(500, 0.1, 35));
    const Structure structure(world.input());
    Dice dice(36);
    for (int i = 0; i < 300; ++i) {
        Ray ray{dice.in(world.bounds()), -unbounded, Vec3(0.0), unbounded};
        const int axis = i % 3;
        ray.direction[axis] = dice.below(2) == 0 ? 1.0 : -3.0;
        ray.direction[(axis + 1) % 3] = dice.below(2) == 0 ? 5e-324 : -1e-310;
        ray.direction[(axis + 2) % 3] = dice.below(2) == 0 ? 1e-300 : -0.0;
        compare_with_windows(world, structure, ray);
    }
}

// The faces of cubes with whole coordinates.
inline Soup cubes(int n) {
    Soup soup;
    const auto quad = [&](const Vec3& p, const Vec3& u, const Vec3& v) {
        soup.push_back({p, p + u, p + u + v});
        soup.push_back({p, p + u + v, p + v});
    };
    const Vec3 x(1, 0, 0);
    const Vec3 y(0, 1, 0);
    const Vec3 z(0, 0, 1);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            for (int k = 0; k < n; ++k) {
                const Vec3 p(i, j, k);
                quad(p, x, y);
                quad(p, y, z);
                quad(p, z, x);
                if ((i + j + k) % 2 == 0) quad(p + x, y, z);
            }
        }
    }
    return soup;
}

// A sheet of n x n squares across the axis; bumps: how far out of the plane.
inline Soup sheet(int n, int axis, double bumps) {
    Dice dice(17);
    const int ax = (axis + 1) % 3;
    const int ay = (axis + 2) % 3;
    std::vector<double> heights(static_cast<std::size_t>((n + 1) * (n + 1)));
    for (double& h : heights) h = 0.3 + bumps * dice.between(-1.0, 1.0);
    const auto point = [&](int i, int j) {
        Vec3 p;
        p[axis] = heights[static_cast<std::size_t>(i * (n + 1) + j)];
        p[ax] = i / 7.0;
        p[ay] = j / 7.0;
        return p;
    };
    Soup soup;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            soup.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
            soup.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
        }
    }
    return soup;
}

inline Soup moved(Soup soup, double scale, const Vec3& offset) {
    for (Corners& c : soup) {
        for (Vec3& p : c) p = scale * p + offset;
    }
    return soup;
}

// 1 x 1e-4 x 1e-9.
inline Soup needle() {
    Soup soup = random_soup(400, 0.02, 8);
    for (Corners& c : soup) {
        for (Vec3& p : c) p *= Vec3(1.0, 1e-4, 1e-9);
    }
    return soup;
}

inline Soup joined(Soup a, const Soup& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

// Slivers, repeats, triangles without area and with NaN, among others.
inline Soup bad_company() {
    Soup soup = random_soup(60, 0.2, 5);
    soup = joined(soup, soup);
    soup = joined(soup, {soup[3], soup[3], soup[3]});
    const Vec3 p(0.5, 0.5, 0.5);
    soup.push_back({p, p, p});
    soup.push_back({p, p + Vec3(1, 1, 1), p + Vec3(2, 2, 2)}); // outside the bounds of the others
    soup.push_back({p, Vec3(std::nan("")), p + Vec3(1, 0, 0)});
    soup.push_back({p, p + Vec3(0.4, 0.3, 0.2), p + Vec3(0.2, 0.15, 0.1 + 1e-16)});
    soup.push_back({Vec3(0.1, 0.2, 0.3), Vec3(0.9, 0.8, 0.7), Vec3(0.9, 0.8, 0.7 + 1e-13)});
    soup.push_back({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1e-9, 0)});
    return soup;
}

inline Soup sticks() {
    Dice dice(23);
    Soup soup;
    for (int i = 0; i < 150; ++i) {
        const Vec3 a = dice.in({Vec3(0.0), Vec3(1.0)});
        const Vec3 b = dice.in({Vec3(0.0), Vec3(1.0)});
        soup.push_back({a, b, b + 1e-3 * dice.unit()});
    }
    return soup;
}

inline Soup rounded_to_float(Soup soup) {
    for (Corners& c : soup) {
        for (Vec3& p : c) p = Vec3(Vec3f(p));
    }
    return soup;
}

inline std::vector<NamedSoup> hard_scenes() {
    return {
        {"empty", [] { return Soup{}; }},
        {"only_degenerate",
         [] {
             return Soup{{Vec3(0.0), Vec3(1.0), Vec3(2.0)}, {Vec3(3.0), Vec3(3.0), Vec3(3.0)}};
         }},
        {"one", [] { return random_soup(1, 1.0, 1); }},
        {"one_across_x",
         [] {
             return Soup{{Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(2, 0, 1)}};
         }},
        {"two", [] { return random_soup(2, 0.5, 2); }},
        {"ten_small", [] { return random_soup(10, 0.01, 3); }},
        {"hundred_large", [] { return random_soup(100, 1.0, 4); }},
        {"thousand_small", [] { return random_soup(1000, 0.03, 5); }},
        {"three_thousand", [] { return random_soup(3000, 0.02, 6); }},
        {"floats", [] { return rounded_to_float(random_soup(1500, 0.05, 7)); }},
        {"cubes", [] { return cubes(6); }},
        {"thin_cubes", [] { return moved(cubes(4), 0.1, Vec3(0.1)); }},
        {"flat_x", [] { return sheet(14, 0, 0.0); }},
        {"flat_y", [] { return sheet(14, 1, 0.0); }},
        {"flat_z", [] { return sheet(14, 2, 0.0); }},
        {"nearly_flat_z", [] { return sheet(14, 2, 1e-12); }},
        {"bumpy_x", [] { return sheet(14, 0, 0.2); }},
        {"same_one_500_times",
         [] {
             return Soup(500, {Vec3(0, 0, 0), Vec3(1, 0, 0.5), Vec3(0, 1, 0.25)});
         }},
        {"same_flat_one_500_times",
         [] {
             return Soup(500, {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1)});
         }},
        {"bad_company", bad_company},
        {"sticks", sticks},
        {"needle", needle},
        {"stadium", [] { return joined(moved(random_soup(700, 0.05, 9), 1e-3, Vec3(0.3, 0.7, 0.2)), cubes(1)); }},
        {"tiny", [] { return moved(random_soup(400, 0.05, 10), 1e-8, Vec3(0.0)); }},
        {"tiny_e30", [] { return moved(random_soup(400, 0.05, 11), 1e-30, Vec3(0.0)); }},
        {"tiny_e60", [] { return moved(random_soup(100, 0.05, 12), 1e-60, Vec3(0.0)); }},
        {"tiny_e300", [] { return moved(random_soup(50, 0.05, 12), 1e-300, Vec3(0.0)); }},
        {"huge_e8", [] { return moved(random_soup(400, 0.05, 13), 1e8, Vec3(0.0)); }},
        {"huge_e30", [] { return moved(random_soup(400, 0.05, 14), 1e30, Vec3(0.0)); }},
        {"huge_e38", [] { return moved(random_soup(200, 0.05, 15), 2e38, Vec3(0.0)); }},
        {"millimetres_5000_km_away", [] { return moved(random_soup(400, 0.05, 16), 1.0, Vec3(5e6, -5e6, 5e6)); }},
        {"far_cubes", [] { return moved(cubes(5), 0.125, Vec3(5e6, 3e6, -4e6)); }},
        {"far_from_zero_e15", [] { return moved(cubes(3), 1.0, Vec3(1e15, 0.0, -1e15)); }},
        {"far_along_x", [] { return moved(random_soup(300, 0.05, 18), 1.0, Vec3(1e9, 0.0, 0.0)); }},
    };
}

// ---- progress ----

// A million triangles in one place, which all lie in the same cells, with references that memory bears, for few rays and many; one
// far off makes those cells a small part of all.
template <class Structure>
void expect_bears_a_million_equal_triangles() {
    const Corners triangle{Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.5), Vec3(0.0, 1.0, 0.25)};
    for (const bool with_another : {false, true}) {
        Soup soup(1000000, triangle);
        if (with_another) soup.push_back({Vec3(90.0), Vec3(91.0, 90.0, 90.0), Vec3(90.0, 91.0, 90.0)});
        World world(soup);
        for (const std::uint64_t rays : {100u, 10000000u}) {
            BuildInput input = world.input();
            input.rays = rays;
            const Structure structure(input);
            EXPECT_LT(structure.bytes(), 200u * soup.size());
            const Ray through{Vec3(0.25, 0.25, 9.0), 0.0, Vec3(0.0, 0.0, -1.0), unbounded};
            EXPECT_EQ(structure.closest(through, {}).primitive, 0u);
            EXPECT_TRUE(structure.any(through, {}));
            std::vector<PrimitiveHit> all;
            structure.all(through, {}, all);
            EXPECT_EQ(all.size(), 1000000u);
            const Ray beside{Vec3(1.25, 0.25, 9.0), 0.0, Vec3(0.0, 0.0, -1.0), unbounded};
            EXPECT_FALSE(structure.closest(beside, {}).is_hit());
        }
    }
}

template <class Structure>
void expect_stops_when_asked(int call) {
    int calls = 0;
    World world(random_soup(50000, 0.01, 34), 2, [&](double, const char*) { return ++calls == call; });
    EXPECT_THROW(Structure(world.input()), Error);
}

template <class Structure>
void expect_progress_from_zero_to_one() {
    std::vector<double> fractions;
    World world(random_soup(50000, 0.01, 34), 1, [&](double fraction, const char*) {
        fractions.push_back(fraction);
        return false;
    });
    const Structure structure(world.input());
    ASSERT_GE(fractions.size(), 4u);
    for (std::size_t i = 0; i < fractions.size(); ++i) {
        EXPECT_GE(fractions[i], i == 0 ? 0.0 : fractions[i - 1]);
        EXPECT_LE(fractions[i], 1.0);
    }
}

} // namespace raywise::grid_kd_testing
