#include "contract/nearness.h"

#include <gtest/gtest.h>

#include <cmath>

namespace raywise::contract {
namespace {

const Vec3 triangle[3] = {Vec3(0.0), Vec3(4.0, 0.0, 0.0), Vec3(0.0, 4.0, 0.0)};

TEST(Nearness, OfPointsAboveTheInside) {
    EXPECT_DOUBLE_EQ(distance({1.0, 1.0, 0.0}, triangle), 0.0);
    EXPECT_DOUBLE_EQ(distance({1.0, 1.0, 3.0}, triangle), 3.0);
    EXPECT_DOUBLE_EQ(distance({1.0, 1.0, -3.0}, triangle), 3.0);
}

TEST(Nearness, OfPointsBesideEdgesAndCorners) {
    EXPECT_DOUBLE_EQ(distance({2.0, -3.0, 4.0}, triangle), 5.0);
    EXPECT_DOUBLE_EQ(distance({4.0, 4.0, 0.0}, triangle), std::sqrt(8.0));
    EXPECT_DOUBLE_EQ(distance({-3.0, -4.0, 0.0}, triangle), 5.0);
    EXPECT_DOUBLE_EQ(distance({7.0, -4.0, 0.0}, triangle), 5.0);
}

TEST(Nearness, ATriangleWithoutAreaIsNearNothing) {
    const Vec3 flat[3] = {Vec3(0.0), Vec3(1.0), Vec3(2.0)};
    EXPECT_TRUE(std::isinf(distance({1.0, 1.0, 1.0}, flat)));
}

} // namespace
} // namespace raywise::contract
