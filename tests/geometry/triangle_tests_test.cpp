// Many triangle tests at once, beside the test of one ray.
#include "geometry/triangle_tests.h"

#include "every_target.h"
#include "geometry/primitives.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace raywise {
namespace {

struct Case {
    Ray ray;
    Corners corners;
};

Box bounds_of(const Corners& corners) {
    Box bounds;
    for (const Vec3& corner : corners) bounds.extend(corner);
    return bounds;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

struct Counts {
    std::size_t hits = 0;
    std::size_t misses = 0;
    std::size_t unknown = 0;
};

// Whatever is not unknown has to be the answer for one ray, bit for bit.
Counts compare(const std::vector<Case>& cases) {
    Counts counts;
    TriangleTests tests;
    std::size_t first = 0;
    const auto look_at = [&] {
        tests.run();
        for (std::size_t k = 0; k < tests.size(); ++k) {
            const auto& [ray, corners] = cases[first + k];
            PrimitiveHit hit;
            const bool hits = Primitives::test_corners(PreparedRay(ray, bounds_of(corners)), corners, 0, hit);
            switch (tests.answer(k)) {
                case TriangleTests::Answer::unknown:
                    ++counts.unknown;
                    break;
                case TriangleTests::Answer::misses:
                    ++counts.misses;
                    EXPECT_FALSE(hits) << first + k;
                    break;
                case TriangleTests::Answer::hits:
                    ++counts.hits;
                    EXPECT_TRUE(hits) << first + k;
                    EXPECT_TRUE(same_bits(hit.t, tests.t(k)) && same_bits(hit.u, tests.u(k)) &&
                                same_bits(hit.v, tests.v(k)))
                        << first + k;
                    break;
            }
        }
        first += tests.size();
        tests.clear();
    };
    for (const Case& c : cases) {
        tests.add(c.ray, c.corners);
        if (tests.is_full()) look_at();
    }
    look_at();
    EXPECT_EQ(first, cases.size());
    return counts;
}

class Maker {
public:
    double number() { return uniform_(engine_); }
    Vec3 vector() { return {number(), number(), number()}; }

    // A ray that passes a point of the triangle's plane, often one inside.
    Case make(double scale, double size, const Vec3& far) {
        Case c;
        const Vec3 middle = scale * vector();
        for (Vec3& corner : c.corners) corner = far + middle + size * vector();
        const double u = std::abs(number()) * 0.6;
        const double v = std::abs(number()) * 0.6;
        const Vec3 target = (1.0 - u - v) * c.corners[0] + u * c.corners[1] + v * c.corners[2];
        c.ray.origin = far + 2.0 * scale * vector();
        c.ray.direction = target - c.ray.origin;
        return c;
    }

private:
    std::mt19937_64 engine_{7};
    std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

TEST(TriangleTests, AnswerAsForOneRay) {
    Maker maker;
    std::vector<Case> cases;
    for (int i = 0; i < 20000; ++i) cases.push_back(maker.make(1.0, 0.1, Vec3(0.0)));
    on_every_target([&] {
        const Counts counts = compare(cases);
        EXPECT_GT(counts.hits, 10000u);
        EXPECT_GT(counts.misses, 1000u);
        EXPECT_LT(counts.unknown, 300u);
    });
}

TEST(TriangleTests, AnswerAsForOneRayAtAnySizeAndLength) {
    Maker maker;
    std::vector<Case> cases;
    for (const double scale : {1e-30, 1e-3, 1e6, 1e30}) {
        for (const double size : {1e-9, 1e-3, 1.0}) {
            for (const double length : {1e-290, 1e-20, 1.0, 1e20, 1e300}) {
                for (int i = 0; i < 200; ++i) {
                    cases.push_back(maker.make(scale, scale * size, Vec3(i % 3 == 0 ? 1e3 * scale : 0.0)));
                    const double largest = max_component(magnitudes(cases.back().ray.direction));
                    cases.back().ray.direction *= length / largest;
                }
            }
        }
    }
    on_every_target([&] { EXPECT_GT(compare(cases).hits, cases.size() / 4); });
}

TEST(TriangleTests, KeepToTheInterval) {
    Maker maker;
    std::vector<Case> cases;
    for (int i = 0; i < 20000; ++i) {
        cases.push_back(maker.make(1.0, 0.3, Vec3(0.0)));
        Ray& ray = cases.back().ray;
        ray.tmin = 1.0 + 0.2 * maker.number();
        ray.tmax = 1.0 + 0.2 * maker.number();
        if (i % 4 == 0) ray.tmin = -std::numeric_limits<double>::infinity();
        if (i % 4 == 1) ray.tmax = std::numeric_limits<double>::infinity();
        if (i % 4 == 2) ray.tmin = ray.tmax = 1.0; // the hit, as near as can be said
        if (ray.tmin > ray.tmax) std::swap(ray.tmin, ray.tmax);
    }
    on_every_target([&] {
        const Counts counts = compare(cases);
        EXPECT_GT(counts.hits, 3000u);
        EXPECT_GT(counts.misses, 3000u);
    });
}

// On edges and corners, in the plane, from the surface, with components of direction that are none, and with coordinates out of range:
// the test for one ray has to be asked, or the answer is its.
TEST(TriangleTests, LeaveWhatIsHardToTheTestOfOneRay) {
    Maker maker;
    std::vector<Case> cases;
    for (int i = 0; i < 2000; ++i) {
        Case c = maker.make(1.0, 0.5, Vec3(0.0));
        const Corners& p = c.corners;
        switch (i % 8) {
            case 0:
                c.ray.direction = p[static_cast<std::size_t>(i / 8 % 3)] - c.ray.origin;
                break;
            case 1:
                c.ray.direction = 0.5 * (p[0] + p[1]) - c.ray.origin;
                break;
            case 2:
                c.ray.origin = p[0] + (p[1] - p[2]);
                c.ray.direction = p[2] - p[1];
                break;
            case 3:
                c.ray.origin = (p[0] + p[1] + p[2]) / 3.0;
                c.ray.direction = maker.vector();
                break;
            case 4:
                c.ray.direction = Vec3(0.0, 0.0, maker.number() < 0.0 ? -1.0 : 1e-310);
                break;
            case 5:
                c.ray.direction.x = 1e-250 * c.ray.direction.x;
                break;
            case 6:
                for (Vec3& corner : c.corners) corner *= i % 16 < 8 ? 1e200 : 1e-200;
                c.ray.origin *= i % 16 < 8 ? 1e200 : 1e-200;
                break;
            default:
                c.corners[2] = c.corners[1];
                break;
        }
        cases.push_back(c);
    }
    on_every_target([&] { EXPECT_GT(compare(cases).unknown, 100u); });
}

TEST(TriangleTests, OfNoneIsNoTrouble) { EXPECT_EQ(compare({}).hits, 0u); }

} // namespace
} // namespace raywise
