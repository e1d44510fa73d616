// certain_edge() tells most misses at first sight. It may do so only where the closer test says the same.
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
    int certain = 0; // misses told at first sight
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
        for (Vec3& corner : corners) {
            corner = scaled(middle + size * point(), exponent);
        }
        const double s = number() > 0.0 ? 0.25 : 0.0;
        const double beside = std::ldexp(size, -static_cast<int>(random_() % 60));
        const Vec3 target = (1.0 - s) * corners[0] + s * corners[1] + scaled(beside * point(), exponent);
        const Vec3 origin = target + scaled(away * point(), exponent);
        const Ray ray{origin, 0.0, target - origin};
        if (!ray.is_traceable()) return;
        double distance = 0.0;
        for (const Vec3& corner : corners) distance = larger(distance, max_component(magnitudes(corner - origin)));
        // As if some triangle of the same leaf were farther away.
        compare(ExactRay(ray), corners, certain_edge((1.0 + 3.0 * static_cast<double>(random_() % 2)) * distance));
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

    void compare(const ExactRay& ray, const Vec3 (&c)[3], double certain) {
        const Sheared sa = shear(ray, c[0]);
        const Sheared sb = shear(ray, c[1]);
        const Sheared sc = shear(ray, c[2]);
        const Edges edges{edge(sb, sc), edge(sc, sa), edge(sa, sb)};
        TriangleHit found{};
        const bool hits = test_triangle(ray, c[0], c[1], c[2], found);
        const bool misses = std::max(std::max(edges.wa, edges.wb), edges.wc) > certain &&
                            std::min(std::min(edges.wa, edges.wb), edges.wc) < -certain;
        ASSERT_FALSE(hits && misses);
        ++counts_.tests;
        counts_.hits += hits ? 1 : 0;
        counts_.certain += misses ? 1 : 0;
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
        if (exponent > -370 && exponent < 398) {
            EXPECT_GT(trials.counts().certain, 0) << exponent;
        }
        if (exponent < -375 || exponent > 401) {
            EXPECT_EQ(trials.counts().certain, 0) << exponent;
        }
    }
}

} // namespace
} // namespace raywise
