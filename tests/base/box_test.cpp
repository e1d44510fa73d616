#include "base/box.h"
#include "base/lanes.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace raywise {
namespace {

TEST(Box, IsEmptyUntilExtended) {
    Box box;
    EXPECT_TRUE(box.empty());
    EXPECT_EQ(box.half_area(), 0.0);
    box.extend(Vec3(1.0, 2.0, 3.0));
    EXPECT_FALSE(box.empty());
    EXPECT_EQ(box.lower, box.upper);
}

TEST(Box, HalfAreaIsHalfTheSurface) {
    Box box;
    box.extend(Vec3(0.0));
    box.extend(Vec3(1.0, 2.0, 3.0));
    EXPECT_EQ(box.half_area(), 2.0 + 6.0 + 3.0);
    EXPECT_EQ(box.longest_axis(), 2);
}

TEST(Rounding, EnclosesEveryDoubleByTheNearestFloats) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> exponent(-40.0, 38.0);
    for (int i = 0; i < 100000; ++i) {
        const double x = (random() & 1 ? 1.0 : -1.0) * std::pow(10.0, exponent(random));
        const float low = round_down(x);
        const float high = round_up(x);
        ASSERT_LE(static_cast<double>(low), x);
        ASSERT_GE(static_cast<double>(high), x);
        ASSERT_LE(high, std::nextafter(low, std::numeric_limits<float>::infinity()));
    }
}

TEST(Rounding, KeepsFloatsAsTheyAre) {
    for (const float x :
         {0.0f, 1.0f, -3.5f, std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min()}) {
        EXPECT_EQ(round_down(static_cast<double>(x)), x);
        EXPECT_EQ(round_up(static_cast<double>(x)), x);
    }
}

TEST(Rounding, IsTheSameInLanes) {
    constexpr double most = std::numeric_limits<float>::max();
    constexpr double least = std::numeric_limits<float>::denorm_min();
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> exponent(-46.0, 38.0);
    for (int i = 0; i < 100000; ++i) {
        const double x = (random() & 1 ? 1.0 : -1.0) * std::pow(10.0, exponent(random));
        const double special[] = {0.0, -0.0, most, -most, 0.5 * least, -0.5 * least, 1e-300, -1e-300};
        const DoubleLanes all{x, special[i % 8], static_cast<double>(static_cast<float>(x)), -x};
        const Lanes low = round_down(all);
        const Lanes high = round_up(all);
        for (int lane = 0; lane < 4; ++lane) {
            ASSERT_EQ(low[lane], round_down(all[lane])) << all[lane];
            ASSERT_EQ(high[lane], round_up(all[lane])) << all[lane];
        }
    }
}

TEST(Rounding, BoxHoldsTheDoubleBox) {
    Box box;
    box.extend(Vec3(0.1, -0.1, 1e-300));
    box.extend(Vec3(0.3, 0.7, 5e6 + 0.001));
    const BoxF rounded = round_outwards(box);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(static_cast<double>(rounded.lower[axis]), box.lower[axis]);
        EXPECT_GE(static_cast<double>(rounded.upper[axis]), box.upper[axis]);
    }
}

} // namespace
} // namespace raywise
