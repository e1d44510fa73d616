#include "ray/exact_ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace raywise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Ray, WithNothingToTraceIsRecognised) {
    const Ray good{{0, 0, 0}, 0.0, {0, 0, 1}, infinity};
    EXPECT_TRUE(good.is_traceable());
    EXPECT_FALSE((Ray{{0, 0, 0}, 0.0, {0, 0, 0}, infinity}.is_traceable()));
    EXPECT_FALSE((Ray{{0, 0, 0}, 0.0, {-0.0, 0, 0}, infinity}.is_traceable()));
    EXPECT_FALSE((Ray{{nan, 0, 0}, 0.0, {0, 0, 1}, infinity}.is_traceable()));
    EXPECT_FALSE((Ray{{0, 0, 0}, 0.0, {0, nan, 1}, infinity}.is_traceable()));
    EXPECT_FALSE((Ray{{0, 0, 0}, nan, {0, 0, 1}, infinity}.is_traceable()));
    EXPECT_FALSE((Ray{{0, 0, 0}, 0.0, {0, 0, 1}, nan}.is_traceable()));
    EXPECT_FALSE((Ray{{0, infinity, 0}, 0.0, {0, 0, 1}, infinity}.is_traceable()));
    EXPECT_FALSE((Ray{{0, 0, 0}, 0.0, {0, 0, -infinity}, infinity}.is_traceable()));
    EXPECT_FALSE((Ray{{0, 0, 0}, 2.0, {0, 0, 1}, 1.0}.is_traceable()));
    EXPECT_TRUE((Ray{{0, 0, 0}, 1.0, {0, 0, 1}, 1.0}.is_traceable()));
}

TEST(Ray, TellsANanFromAnInfinity) {
    EXPECT_TRUE((Ray{{nan, 0, 0}, 0.0, {0, 0, 1}, infinity}.has_nan()));
    EXPECT_TRUE((Ray{{0, 0, 0}, 0.0, {0, 0, 1}, nan}.has_nan()));
    EXPECT_FALSE((Ray{{0, 0, 0}, 0.0, {0, 0, 1}, infinity}.has_nan()));
    EXPECT_FALSE((Ray{{infinity, -infinity, 0}, -infinity, {infinity, -infinity, 1}, infinity}.has_nan()));
}

TEST(Ray, ThatMayHaveANanIsNotOverlooked) {
    const Ray good{{1, 2, 3}, -infinity, {4, 5, 6}, infinity};
    for (int i = 0; i < 8; ++i) {
        Ray ray = good;
        double& number = i < 3 ? ray.origin[i] : i < 6 ? ray.direction[i - 3] : i == 6 ? ray.tmin : ray.tmax;
        number = nan;
        EXPECT_TRUE(ray.has_nan()) << i;
        EXPECT_TRUE(ray.may_have_nan()) << i;
    }
    EXPECT_FALSE((Ray{{1, 2, 3}, 0.0, {4, 5, 6}, infinity}.may_have_nan()));
}

TEST(ExactRay, ScalesTheDirectionByAPowerOfTwo) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> exponent(-300.0, 300.0);
    for (int i = 0; i < 10000; ++i) {
        const double length = std::pow(10.0, exponent(random));
        const Ray ray{{1, 2, 3}, 0.0, {0.3 * length, -length, 0.7 * length}, infinity};
        const ExactRay exact(ray);
        EXPECT_EQ(exact.major_axis, 1);
        EXPECT_GE(std::fabs(exact.direction.y), 1.0);
        EXPECT_LT(std::fabs(exact.direction.y), 2.0);
        EXPECT_EQ(exact.direction.x / exact.direction.y, ray.direction.x / ray.direction.y);
        EXPECT_EQ(exact.scale.to_caller(exact.scale.from_caller(0.7)), 0.7);
    }
}

TEST(ExactRay, ScalesWithoutRoundingAtTheEndsOfTheRange) {
    for (const double length : {1.0, 3.0, 1e-300, 1e300, 0x1p-1074}) {
        const ExactRay ray({{0, 0, 0}, 0.0, {0.5 * length, -length, 0}, 7.0});
        EXPECT_GE(std::fabs(ray.direction.y), 1.0);
        EXPECT_LT(std::fabs(ray.direction.y), 2.0);
        EXPECT_EQ(ray.major_axis, 1);
    }
}

TEST(ExactRay, HoldsWhatIsInItsIntervalAndCanBeTold) {
    const ExactRay ray({{0, 0, 0}, -3.0, {0, 0, 5.0}, 7.0});
    EXPECT_TRUE(ray.contains(-3.0));
    EXPECT_TRUE(ray.contains(7.0));
    EXPECT_FALSE(ray.contains(std::nextafter(7.0, infinity)));
    EXPECT_FALSE(ray.contains(std::nextafter(-3.0, -infinity)));
    EXPECT_FALSE(ExactRay({{0, 0, 0}, 0.0, {0, 0, 1}, infinity}).contains(infinity)) << "a t that overflowed";
    EXPECT_FALSE(ray.contains(nan));
}

} // namespace
} // namespace raywise
