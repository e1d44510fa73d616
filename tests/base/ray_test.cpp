#include "base/ray.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace raywise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Box unit_box() { return {Vec3(-1.0), Vec3(1.0)}; }

TEST(Ray, WithNothingToTraceIsRecognised) {
    const Ray good{{0, 0, 0}, 0.0, {0, 0, 1}, infinity};
    EXPECT_TRUE(PreparedRay::is_traceable(good));
    EXPECT_FALSE(PreparedRay::is_traceable({{0, 0, 0}, 0.0, {0, 0, 0}, infinity}));
    EXPECT_FALSE(PreparedRay::is_traceable({{0, 0, 0}, 0.0, {-0.0, 0, 0}, infinity}));
    EXPECT_FALSE(PreparedRay::is_traceable({{nan, 0, 0}, 0.0, {0, 0, 1}, infinity}));
    EXPECT_FALSE(PreparedRay::is_traceable({{0, 0, 0}, 0.0, {0, nan, 1}, infinity}));
    EXPECT_FALSE(PreparedRay::is_traceable({{0, 0, 0}, nan, {0, 0, 1}, infinity}));
    EXPECT_FALSE(PreparedRay::is_traceable({{0, 0, 0}, 0.0, {0, 0, 1}, nan}));
    EXPECT_FALSE(PreparedRay::is_traceable({{0, infinity, 0}, 0.0, {0, 0, 1}, infinity}));
    EXPECT_FALSE(PreparedRay::is_traceable({{0, 0, 0}, 0.0, {0, 0, -infinity}, infinity}));
    EXPECT_FALSE(PreparedRay::is_traceable({{0, 0, 0}, 2.0, {0, 0, 1}, 1.0}));
    EXPECT_TRUE(PreparedRay::is_traceable({{0, 0, 0}, 1.0, {0, 0, 1}, 1.0}));
}

TEST(Ray, TellsANanFromAnInfinity) {
    EXPECT_TRUE((Ray{{nan, 0, 0}, 0.0, {0, 0, 1}, infinity}.has_nan()));
    EXPECT_TRUE((Ray{{0, 0, 0}, 0.0, {0, 0, 1}, nan}.has_nan()));
    EXPECT_FALSE((Ray{{0, 0, 0}, 0.0, {0, 0, 1}, infinity}.has_nan()));
    EXPECT_FALSE((Ray{{infinity, -infinity, 0}, -infinity, {infinity, -infinity, 1}, infinity}.has_nan()));
}

TEST(PreparedRay, ScalesTheDirectionByAPowerOfTwo) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> exponent(-300.0, 300.0);
    for (int i = 0; i < 10000; ++i) {
        const double length = std::pow(10.0, exponent(random));
        const Ray ray{{1, 2, 3}, 0.0, {0.3 * length, -length, 0.7 * length}, infinity};
        const PreparedRay prepared(ray, unit_box());
        EXPECT_EQ(prepared.major_axis, 1);
        EXPECT_GE(std::fabs(prepared.direction.y), 1.0);
        EXPECT_LT(std::fabs(prepared.direction.y), 2.0);
        EXPECT_EQ(prepared.direction.x / prepared.direction.y, ray.direction.x / ray.direction.y);
        EXPECT_EQ(prepared.to_caller(prepared.from_caller(0.7)), 0.7);
    }
}

// Where the interval's ends fall below the normal numbers they are rounded to the inside.
TEST(PreparedRay, NeverWidensTheInterval) {
    constexpr double smallest = std::numeric_limits<double>::denorm_min();
    for (const double scale : {0x1p-60, 0.03, 1.0, 3.0, 0x1p60}) {
        for (const double limit : {smallest, 3 * smallest, 5 * smallest, 1001 * smallest}) {
            const PreparedRay ray({{0, 0, 0}, limit, {0, scale, 0}, limit}, unit_box());
            EXPECT_GE(ray.to_caller(ray.tmin), limit) << scale;
            EXPECT_LE(ray.to_caller(ray.tmax), limit) << scale;
        }
    }
}

TEST(BoxInterval, MeetsABoxFromEveryDirection) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    for (int i = 0; i < 100000; ++i) {
        const Vec3 inside(coordinate(random), coordinate(random), coordinate(random));
        Vec3 direction(coordinate(random), coordinate(random), coordinate(random));
        if (i % 7 == 0) direction.x = 0.0;
        if (i % 5 == 0) direction.y = -0.0;
        if (direction == Vec3(0.0)) continue;
        const PreparedRay ray({inside - 3.0 * direction, 0.0, direction, infinity}, unit_box());
        double near = 0.0;
        ASSERT_TRUE(may_hit_box(ray, unit_box(), infinity, near));
    }
}

TEST(BoxInterval, MeetsAFlatBoxInItsPlane) {
    const Box flat{{-1, 0, -1}, {1, 0, 1}};
    double near = 0.0;
    EXPECT_TRUE(may_hit_box(PreparedRay({{-5, 0, 0}, 0.0, {1, 0, 0}, infinity}, flat), flat, infinity, near));
    EXPECT_TRUE(may_hit_box(PreparedRay({{-5, 0, 0}, 0.0, {1, -0.0, 0}, infinity}, flat), flat, infinity, near));
    EXPECT_FALSE(may_hit_box(PreparedRay({{-5, 1e-3, 0}, 0.0, {1, 0, 0}, infinity}, flat), flat, infinity, near));
}

TEST(BoxInterval, RespectsTheRaysInterval) {
    double near = 0.0;
    const Ray towards{{-5, 0, 0}, 0.0, {1, 0, 0}, infinity};
    EXPECT_TRUE(may_hit_box(PreparedRay(towards, unit_box()), unit_box(), infinity, near));
    EXPECT_NEAR(near, 4.0, 1e-12);
    EXPECT_FALSE(may_hit_box(PreparedRay(towards, unit_box()), unit_box(), 3.9, near));
    const Ray beyond{{-5, 0, 0}, 6.5, {1, 0, 0}, infinity};
    EXPECT_FALSE(may_hit_box(PreparedRay(beyond, unit_box()), unit_box(), infinity, near));
    const Ray away{{-5, 0, 0}, 0.0, {-1, 0, 0}, infinity};
    EXPECT_FALSE(may_hit_box(PreparedRay(away, unit_box()), unit_box(), infinity, near));
}

} // namespace
} // namespace raywise
