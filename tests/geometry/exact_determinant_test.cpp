// The determinant against fractions: the sign always, the value to a few units in the last place.
#include "geometry/exact_determinant.h"

#include "oracle/judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace raywise {
namespace {

using oracle::Fraction;

int sign_of(double x) { return (x > 0.0) - (x < 0.0); }

AxisScale scale_of(const Vec3& o, const Vec3& p, const Vec3& q) {
    return AxisScale::of(glm::max(glm::abs(p - o), glm::abs(q - o)));
}

double determinant(const Vec3& d, const Vec3& o, const Vec3& p, const Vec3& q) {
    return exact_determinant(d, o, p, q, scale_of(o, p, q));
}

// The sign has to be right, and the value but for a power of two.
void expect_exact(const Vec3& d, const Vec3& o, const Vec3& p, const Vec3& q) {
    const double value = determinant(d, o, p, q);
    const Fraction wanted = oracle::exact_determinant_value(d, o, p, q);
    ASSERT_EQ(sign_of(value), wanted.sign()) << value << " instead of " << wanted.convert_to<double>();
    EXPECT_EQ(determinant(d, o, q, p), -value) << "swapping has to negate";
    if (wanted == 0) return;
    // The ratio, brought near 1 by a power of two.
    Fraction ratio = oracle::exact(value) / wanted;
    const auto top_bit = [](const oracle::Integer& n) { return static_cast<int>(boost::multiprecision::msb(n)); };
    const int exponent = top_bit(numerator(ratio)) - top_bit(denominator(ratio));
    const oracle::Integer power = oracle::Integer(1) << static_cast<unsigned>(std::abs(exponent));
    ratio = exponent > 0 ? Fraction(ratio / power) : Fraction(ratio * power);
    const double mantissa = ratio.convert_to<double>();
    EXPECT_LE(
        std::min(std::fabs(mantissa - 1.0), std::min(std::fabs(mantissa / 2.0 - 1.0), std::fabs(mantissa * 2.0 - 1.0))),
        0x1p-50)
        << mantissa;
}

class Numbers {
public:
    // Of any sign and of an exponent in the range.
    double number(int low, int high) {
        const double mantissa = 1.0 + static_cast<double>(random_() >> 12) * 0x1p-52;
        const int exponent = low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
        return std::ldexp(random_() % 2 == 0 ? mantissa : -mantissa, exponent);
    }
    Vec3 vector(int low, int high) {
        const double x = number(low, high);
        const double y = number(low, high);
        return {x, y, number(low, high)};
    }
    int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }

private:
    std::mt19937_64 random_{17};
};

TEST(ExactDeterminant, IsExactForAnyNumbers) {
    Numbers numbers;
    for (int i = 0; i < 5000; ++i) {
        expect_exact(numbers.vector(-3, 0), numbers.vector(-2, 2), numbers.vector(-2, 2), numbers.vector(-2, 2));
        expect_exact(numbers.vector(-60, 0), numbers.vector(-60, 60), numbers.vector(-60, 60), numbers.vector(-60, 60));
    }
}

TEST(ExactDeterminant, KnowsZero) {
    Numbers numbers;
    for (int i = 0; i < 2000; ++i) {
        // q is on the line through o along d, as far as small integers keep it exact.
        const Vec3 d(numbers.below(1000) - 500, numbers.below(1000) - 500, numbers.below(1000) + 1);
        const Vec3 o(numbers.below(1000), numbers.below(1000), numbers.below(1000));
        const Vec3 q = o + 3.0 * d;
        const Vec3 p = numbers.vector(-20, 20);
        EXPECT_EQ(determinant(d, o, p, q), 0.0);
        expect_exact(d, o, p, q + Vec3(0, 0, 0x1p-30));
        EXPECT_EQ(determinant(d, o, p, p), 0.0);
        EXPECT_EQ(determinant(d, o, o, q), 0.0);
    }
}

TEST(ExactDeterminant, TellsTheLastBit) {
    // d is along x, so the determinant is that of (y, z): 1 - x * x for x next to 1 and the like.
    for (const double x : {1.0 - 0x1p-53, 1.0 + 0x1p-52, 1.0 - 0x1p-30}) {
        expect_exact({1, 0, 0}, {0, 0, 0}, {0, x, 1}, {0, 1, x});
        expect_exact({1, 0, 0}, {0, 0, 0}, {0, x, 1}, {0, 1, 1 / x});
        expect_exact({1, 0x1p-60, 0}, {0, 0, 0}, {5, x, 1}, {7, 1, 1 / x});
    }
}

TEST(ExactDeterminant, IsExactWhereAxesDifferInScale) {
    Numbers numbers;
    for (int i = 0; i < 1000; ++i) {
        int exponents[3];
        for (int& exponent : exponents) exponent = numbers.below(1200) - 600;
        Vec3 points[4];
        for (Vec3& point : points) {
            for (int axis = 0; axis < 3; ++axis) point[axis] = numbers.number(exponents[axis] - 30, exponents[axis]);
        }
        expect_exact(points[0], points[1], points[2], points[3]);
    }
}

// Weights are ratios of determinants: those of one ray and triangle have to come out with the same factor.
TEST(ExactDeterminant, GivesAllWeightsOfATriangleTheSameFactor) {
    Numbers numbers;
    for (int i = 0; i < 500; ++i) {
        const Vec3 d = numbers.vector(-30, 0);
        const Vec3 o = numbers.vector(-3, 3);
        const Vec3 p[3] = {numbers.vector(-3, 3), numbers.vector(-40, 3), numbers.vector(-3, 3)};
        const AxisScale scale =
            AxisScale::of(glm::max(glm::abs(p[0] - o), glm::max(glm::abs(p[1] - o), glm::abs(p[2] - o))));
        const double first = exact_determinant(d, o, p[0], p[1], scale);
        const double second = exact_determinant(d, o, p[1], p[2], scale);
        const Fraction wanted =
            oracle::exact_determinant_value(d, o, p[0], p[1]) / oracle::exact_determinant_value(d, o, p[1], p[2]);
        EXPECT_NEAR(Fraction(oracle::exact(first) / oracle::exact(second) / wanted).convert_to<double>(), 1.0, 0x1p-49);
    }
}

TEST(ExactDeterminant, IsExactForAllOfFloat32) {
    Numbers numbers;
    for (int i = 0; i < 2000; ++i) {
        Vec3 points[3];
        for (Vec3& point : points) {
            for (int axis = 0; axis < 3; ++axis) {
                point[axis] = static_cast<double>(static_cast<float>(numbers.number(-149, 127)));
            }
        }
        expect_exact(numbers.vector(-3, 0), points[0], points[1], points[2]);
    }
}

} // namespace
} // namespace raywise
