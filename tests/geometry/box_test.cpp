// Boxes, and their rounding to float32.
#include "base/box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace raywise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double float_max = std::numeric_limits<float>::max();

TEST(Box, GrowsFromNothing) {
    Box box;
    EXPECT_TRUE(box.empty());
    EXPECT_EQ(box.half_area(), 0.0);
    box.extend(Vec3(1, 2, 3));
    EXPECT_FALSE(box.empty());
    EXPECT_EQ(box.half_area(), 0.0);
    box.extend(Box{{0, 0, 0}, {2, 3, 4}});
    EXPECT_EQ(box.half_area(), 2 * 3 + 3 * 4 + 4 * 2);
    EXPECT_EQ(box.longest_axis(), 2);
    box.extend(Box{});
    EXPECT_EQ(box.size(), Vec3(2, 3, 4)) << "nothing adds nothing";
}

TEST(Box, KeepsItsCenterWithinTheRange) {
    const Box box{Vec3(-float_max), Vec3(float_max)};
    EXPECT_EQ(box.center(), Vec3(0.0));
    EXPECT_TRUE(std::isfinite(box.half_area()));
}

void expect_rounded(double x) {
    const float down = round_down(x);
    const float up = round_up(x);
    EXPECT_LE(static_cast<double>(down), x);
    EXPECT_GE(static_cast<double>(up), x);
    const bool is_float = static_cast<double>(static_cast<float>(x)) == x;
    EXPECT_EQ(down == up, is_float) << x;
    if (!is_float) {
        EXPECT_EQ(std::nextafter(down, up), up) << "the nearest on each side: " << x;
    }
}

TEST(Rounding, FindsTheNearestFloatOnEachSide) {
    for (const double x : {0.0, 1.0, 0.1, 1.0 + 0x1p-30, 16777217.0, 0x1p-149, 0x1p-150, 0x1p-1074, 1e-40,
                           0x1.fffffffp-127, float_max, std::nextafter(float_max, 0.0), 1e38, 3.0}) {
        expect_rounded(x);
        expect_rounded(-x);
    }
    std::mt19937_64 random(1);
    for (int i = 0; i < 10000; ++i) {
        const double mantissa = 1.0 + static_cast<double>(random() >> 12) * 0x1p-52;
        expect_rounded(std::ldexp(i % 2 == 0 ? mantissa : -mantissa, static_cast<int>(random() % 276) - 149));
    }
}

// All six at once as well: optimisers have been seen to leave the rounding of neighbouring numbers out.
TEST(Rounding, HoldsForWholeBoxes) {
    std::mt19937_64 random(4);
    const auto number = [&random] { return 2.0 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1.0; };
    for (int i = 0; i < 5000; ++i) {
        Box box;
        box.extend(Vec3(number(), number(), number()));
        box.extend(Vec3(number(), number(), number()));
        const BoxF rounded = round_outwards(box);
        for (int axis = 0; axis < 3; ++axis) {
            volatile float lower = rounded.lower[axis];
            volatile float upper = rounded.upper[axis];
            ASSERT_LE(static_cast<double>(lower), box.lower[axis]);
            ASSERT_GE(static_cast<double>(upper), box.upper[axis]);
            ASSERT_GT(static_cast<double>(std::nextafter(static_cast<float>(lower), 2.0f)), box.lower[axis]);
            ASSERT_LT(static_cast<double>(std::nextafter(static_cast<float>(upper), -2.0f)), box.upper[axis]);
        }
    }
}

TEST(Rounding, KeepsEmptyBoxesEmpty) {
    const BoxF box = round_outwards(Box{});
    EXPECT_GT(box.lower.x, box.upper.x);
}

} // namespace
} // namespace raywise
