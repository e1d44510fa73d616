// The ray-triangle test on cases known by hand. tests/oracle compares it with exact arithmetic on many more.
#include "geometry/triangle_test.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace raywise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const std::array<Vec3, 3> corners = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};

struct Answer {
    bool hit = false;
    double t = 0.0;
    double u = 0.0;
    double v = 0.0;
};

Answer ask(const Vec3& origin, const Vec3& direction, const std::array<Vec3, 3>& c = corners) {
    const ExactRay ray({origin, 0.0, direction, infinity});
    TriangleHit hit{};
    if (!test_triangle(ray, c[0], c[1], c[2], hit)) return {};
    return {true, hit.t, hit.u, hit.v};
}

TEST(TriangleTest, GivesDistanceAndWeights) {
    const Answer answer = ask({0.25, 0.5, 3}, {0, 0, -2});
    ASSERT_TRUE(answer.hit);
    EXPECT_EQ(answer.t, 1.5);
    EXPECT_EQ(answer.u, 0.25);
    EXPECT_EQ(answer.v, 0.5);
}

TEST(TriangleTest, HitsFromBothSides) {
    EXPECT_TRUE(ask({0.25, 0.25, 3}, {0, 0, -1}).hit);
    EXPECT_TRUE(ask({0.25, 0.25, -3}, {0, 0, 1}).hit);
}

TEST(TriangleTest, TellsOfHitsBehindTheOrigin) {
    const Answer answer = ask({0.25, 0.25, 3}, {0, 0, 1});
    ASSERT_TRUE(answer.hit);
    EXPECT_EQ(answer.t, -3.0);
}

TEST(TriangleTest, CountsCornersAndEdges) {
    for (const Vec3& p :
         {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0), Vec3(0.5, 0.5, 0)}) {
        for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 2, 4), Vec3(-0.5, 0.25, 1)}) {
            EXPECT_TRUE(ask(p - direction, direction).hit);
        }
    }
}

TEST(TriangleTest, MissesByTheSmallestStep) {
    EXPECT_FALSE(ask({-0x1p-1074, 0.5, 1}, {0, 0, -1}).hit);
    EXPECT_FALSE(ask({0.5, -0x1p-1074, 1}, {0, 0, -1}).hit);
    EXPECT_FALSE(ask({0.5, std::nextafter(0.5, 1.0), 1}, {0, 0, -1}).hit);
    EXPECT_TRUE(ask({0.5, std::nextafter(0.5, 0.0), 1}, {0, 0, -1}).hit);
}

TEST(TriangleTest, NeverHitsInItsOwnPlane) {
    EXPECT_FALSE(ask({-1, 0.25, 0}, {1, 0, 0}).hit);
    EXPECT_FALSE(ask({0.25, 0.25, 0}, {1, 1, 0}).hit);
    EXPECT_FALSE(ask({-1, 0, 0}, {1, 0, 0}).hit) << "along an edge";
    EXPECT_FALSE(ask({-1, 0.25, 1}, {1, 0, 0}).hit) << "beside it";
}

TEST(TriangleTest, NeverHitsWhatHasNoArea) {
    EXPECT_FALSE(ask({0, 0, 1}, {0, 0, -1}, {Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)}).hit);
    EXPECT_FALSE(ask({1, 1, 1}, {0, 0, -1}, {Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(2, 2, 0)}).hit);
    EXPECT_FALSE(ask({1, 1, 1}, {0, 0, -1}, {Vec3(0, 0, 0), Vec3(2, 2, 0), Vec3(2, 2, 0)}).hit);
}

TEST(TriangleTest, GivesTheSameHitForAnyLengthOfDirection) {
    const Answer one = ask({0.3, 0.1, 3}, {0.01, 0.02, -1});
    ASSERT_TRUE(one.hit);
    for (const int exponent : {-1000, -500, -1, 1, 500, 1000}) {
        const double factor = std::ldexp(1.0, exponent);
        const Answer other = ask({0.3, 0.1, 3}, factor * Vec3(0.01, 0.02, -1));
        ASSERT_TRUE(other.hit);
        EXPECT_EQ(other.t, std::ldexp(one.t, -exponent));
        EXPECT_EQ(other.u, one.u);
        EXPECT_EQ(other.v, one.v);
    }
}

TEST(TriangleTest, RotatesWeightsWithTheCorners) {
    const Answer first = ask({0.25, 0.5, 1}, {0, 0, -1});
    const Answer second = ask({0.25, 0.5, 1}, {0, 0, -1}, {corners[1], corners[2], corners[0]});
    EXPECT_EQ(second.u, first.v);
    EXPECT_EQ(second.v, 1.0 - first.u - first.v);
}

} // namespace
} // namespace raywise
