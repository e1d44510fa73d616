// test_triangle passes most misses by with one bound for the whole scene. It may do so only where the closer test says the same.
#include "geometry/triangle_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace raywise {
namespace {

using namespace triangle_test_detail;

struct Counts {
    int tests = 0;
    int certain = 0; // misses told by the bound of the scene
    int hits = 0;
};

class Trials {
public:
    explicit Trials(unsigned seed) : random_(seed) {}

    // A triangle of about `size` in a scene of about `scene`, and a ray that passes one of its edges or corners closely, at
    // any distance, from `away`; all times 2^exponent.
    void run(double size, double scene, double away, int exponent) {
        const Vec3 middle = scene * point();
        Vec3 corners[3];
        Box bounds{Vec3(std::ldexp(-2.0 * scene, exponent)), Vec3(std::ldexp(2.0 * scene, exponent))};
        for (Vec3& corner : corners) {
            corner = scaled(middle + size * point(), exponent);
            bounds.extend(corner);
        }
        const double s = number() > 0.0 ? 0.25 : 0.0;
        const double beside = std::ldexp(size, -static_cast<int>(random_() % 60));
        const Vec3 target = (1.0 - s) * corners[0] + s * corners[1] + scaled(beside * point(), exponent);
        const Vec3 origin = target + scaled(away * point(), exponent);
        const Ray ray{origin, 0.0, target - origin};
        if (!PreparedRay::is_traceable(ray)) return;
        compare(PreparedRay(ray, bounds), corners);
    }

    const Counts& counts() const { return counts_; }

private:
    double number() { return static_cast<double>(random_() >> 11) * 0x1p-52 - 1.0; }
    Vec3 point() {
        const double x = number();
        const double y = number();
        return {x, y, number()};
    }
    static Vec3 scaled(const Vec3& v, int exponent) {
        return {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
    }

    void compare(const PreparedRay& ray, const Vec3 (&c)[3]) {
        const Sheared sa = shear(ray, c[0]);
        const Sheared sb = shear(ray, c[1]);
        const Sheared sc = shear(ray, c[2]);
        const Edges edges{edge(sb, sc), edge(sc, sa), edge(sa, sb)};
        TriangleHit expected{};
        TriangleHit found{};
        const bool wanted = test_closely(ray, c[0], c[1], c[2], sa, sb, sc, edges, expected);
        ASSERT_EQ(test_triangle(ray, c[0], c[1], c[2], found), wanted);
        ASSERT_EQ(std::memcmp(&found, &expected, sizeof found), 0);
        ++counts_.tests;
        counts_.hits += wanted ? 1 : 0;
        counts_.certain += std::max(std::max(edges.wa, edges.wb), edges.wc) > ray.certain_edge &&
                                   std::min(std::min(edges.wa, edges.wb), edges.wc) < -ray.certain_edge
                               ? 1
                               : 0;
    }

    std::mt19937_64 random_;
    Counts counts_;
};

TEST(CertainMiss, IsAMissOfTheCloserTest) {
    Trials trials(1);
    for (int i = 0; i < 20000 && !HasFailure(); ++i) {
        const double size = std::ldexp(1.0, -(i % 40));
        trials.run(size, 1.0, std::ldexp(1.0, i % 7 - 3), 0);
    }
    EXPECT_GT(trials.counts().hits, 2000);
    EXPECT_GT(trials.counts().certain, 2000);
    EXPECT_LT(trials.counts().certain, trials.counts().tests - trials.counts().hits) << "some have to be too close";
}

// Where the squares of coordinates leave the range of float64, and around the ends of the range in which the bound is used.
TEST(CertainMiss, IsAMissOfTheCloserTestAtAllScales) {
    for (const int exponent : {-1040, -900, -520, -401, -400, -399, -373, -372, -371, -370, -369, -368,
                               -200,  100,  300,  396,  397,  398,  399,  400,  401,  480,  500}) {
        Trials trials(static_cast<unsigned>(exponent + 2000));
        for (int i = 0; i < 500 && !HasFailure(); ++i) trials.run(std::ldexp(1.0, -(i % 12)), 1.0, 1.0, exponent);
        EXPECT_GT(trials.counts().hits, 20) << exponent;
        // The scene reaches two to four times as far.
        if (exponent > -370 && exponent < 398) {
            EXPECT_GT(trials.counts().certain, 0) << exponent;
        }
        if (exponent < -372 || exponent > 399) {
            EXPECT_EQ(trials.counts().certain, 0) << exponent;
        }
    }
}

} // namespace
} // namespace raywise
