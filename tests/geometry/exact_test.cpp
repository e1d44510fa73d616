// The exact weights and normals against fractions: the decision always, the values to a few units in the last place.
#include "geometry/exact.h"

#include "oracle/judge.h"
#include "ray/exact_ray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace raywise {
namespace {

using oracle::Fraction;

constexpr double infinity = std::numeric_limits<double>::infinity();

Fraction determinant(const Vec3& d, const Vec3& o, const Vec3& p, const Vec3& q) {
    return oracle::exact_determinant_value(d, o, p, q);
}

// (a - origin) . ((b - a) x (c - a))
Fraction volume(const Vec3& origin, const Vec3& a, const Vec3& b, const Vec3& c) {
    Fraction sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 unit(0.0);
        unit[axis] = 1.0;
        sum += (oracle::exact(a[axis]) - oracle::exact(origin[axis])) * determinant(unit, a, b, c);
    }
    return sum;
}

// How far a ratio of two doubles is from the exact one, relative to it.
double relative_error(double numerator, double denominator, const Fraction& wanted) {
    if (wanted == 0) return numerator == 0.0 ? 0.0 : 1.0;
    const Fraction ratio = oracle::exact(numerator) / oracle::exact(denominator) / wanted - 1;
    return std::fabs(ratio.convert_to<double>());
}

// Counts in `met` whether the triangle is met.
void expect_exact(const Vec3& o, const Vec3& direction, const Vec3 (&p)[3], int& met) {
    const Vec3 d = ExactRay(Ray{o, 0.0, direction, infinity}).direction;
    const Fraction wanted[3] = {determinant(d, o, p[1], p[2]), determinant(d, o, p[2], p[0]),
                                determinant(d, o, p[0], p[1])};
    const bool positive = std::any_of(wanted, wanted + 3, [](const Fraction& w) { return w > 0; });
    const bool negative = std::any_of(wanted, wanted + 3, [](const Fraction& w) { return w < 0; });
    Weights weights{};
    ASSERT_EQ(exact_weights(o, d, p[0], p[1], p[2], weights), positive != negative);
    if (positive == negative) return;
    ++met;
    const double found[3] = {weights.a, weights.b, weights.c};
    const auto largest =
        std::max_element(found, found + 3, [](double x, double y) { return std::fabs(x) < std::fabs(y); }) - found;
    ASSERT_GT(std::fabs(found[largest]), 0x1p-800);
    ASSERT_LT(std::fabs(found[largest]), 0x1p800);
    for (int i = 0; i < 3; ++i) {
        if (found[i] != 0.0 || wanted[i] == 0) {
            EXPECT_EQ(found[i] < 0.0, wanted[i] < 0);
            if (std::fabs(found[i]) < 0x1p-1000) continue; // rounded to fewer bits, below 2^-1022
            EXPECT_LE(relative_error(found[i], found[largest], wanted[i] / wanted[largest]), 0x1p-50);
        } else {
            EXPECT_LT(abs(Fraction(wanted[i] / wanted[largest])), oracle::exact(0x1p-1070)) << "lost";
        }
    }
}

class Numbers {
public:
    // Of any sign and of an exponent in the range.
    double number(int low, int high) {
        const double mantissa = 1.0 + static_cast<double>(random_() >> 12) * 0x1p-52;
        const int exponent = low + below(high - low + 1);
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

TEST(ExactWeights, AreThoseOfFractions) {
    Numbers numbers;
    int met = 0;
    for (int i = 0; i < 4000; ++i) {
        for (const int spread : {1, 30, 60}) {
            const Vec3 p[3] = {numbers.vector(-spread, spread), numbers.vector(-spread, spread),
                               numbers.vector(-spread, spread)};
            const Vec3 o = numbers.vector(-spread, spread);
            expect_exact(o, numbers.vector(-spread, 0), p, met);
            expect_exact(o, 0.25 * (p[0] + p[1]) + 0.5 * p[2] - o, p, met);
        }
    }
    EXPECT_GT(met, 5000);
}

TEST(ExactWeights, KnowPointsOfEdgesAndCorners) {
    Numbers numbers;
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
        // Small integers, so that a ray aimed at a corner or the middle of an edge passes exactly through it.
        const auto integer = [&] { return 2.0 * (numbers.below(1000) - 500); };
        Vec3 p[3];
        for (Vec3& corner : p) corner = {integer(), integer(), integer()};
        const Vec3 o(integer(), integer(), integer());
        for (const Vec3& target : {p[0], p[1], 0.5 * (p[1] + p[2]), 0.5 * (p[0] + p[2])}) {
            if (target == o) continue;
            const int before = met;
            expect_exact(o, target - o, p, met);
            const bool edge_on = determinant(target - o, p[0], p[1], p[2]) == 0;
            EXPECT_EQ(met - before, edge_on ? 0 : 1);
            expect_exact(o, target - o + Vec3(0, 0, 0x1p-30), p, met);
        }
    }
}

TEST(ExactWeights, TellTheLastBit) {
    // Along x, so a determinant is that of (y, z): 1 - x * x for x next to 1 and the like.
    int met = 0;
    for (const double x : {1.0 - 0x1p-53, 1.0 + 0x1p-52, 1.0 - 0x1p-30}) {
        for (const double skew : {0.0, 0x1p-60, -0x1p-60}) {
            const Vec3 p[3] = {{5, x, 1}, {7, 1, x}, {6, -1, -1}};
            const Vec3 q[3] = {{5, x, 1}, {7, 1, 1 / x}, {6, -1, -1}};
            expect_exact({0, 0, 0}, {1, skew, 0}, p, met);
            expect_exact({0, 0, 0}, {1, skew, 0}, q, met);
        }
    }
}

// Products of these leave the range of float64 by far: sums of doubles would lose what decides.
TEST(ExactWeights, AreExactForAllDoubles) {
    Numbers numbers;
    int met = 0;
    for (int i = 0; i < 1500; ++i) {
        Vec3 p[3];
        for (Vec3& corner : p) corner = numbers.vector(-1074, 127);
        expect_exact(numbers.vector(-1074, 1023), numbers.vector(-1074, 1023), p, met);
        expect_exact(numbers.vector(-1074, 127), numbers.vector(-3, 0), p, met);
        expect_exact(p[0], p[1] - p[0], p, met);
    }
    // From so far away along a diagonal that a corner's own coordinates are the 2^-1328th part of the products.
    const Vec3 unit[3] = {{0.75, 0, 0}, {0, 0.75, 0}, {0, 0, 0.75}};
    const int before = met;
    for (const Vec3& aside : {Vec3(0.0), Vec3(0x1p612, 0, 0)}) {
        expect_exact(Vec3(0x1p664) + aside, Vec3(-1.0), unit, met);
    }
    EXPECT_EQ(met, before + 1) << "the first is met, the second is not";
}

TEST(PlaneSide, IsThatOfFractions) {
    Numbers numbers;
    int on_plane = 0;
    for (int i = 0; i < 6000; ++i) {
        const int spread = i % 3 == 0 ? 1 : i % 3 == 1 ? 40 : 500;
        const auto vector = [&] { return numbers.vector(-2 * spread, std::min(spread, 127)); };
        const Vec3 a = vector();
        const Vec3 b = vector();
        const Vec3 c = vector();
        // On the plane but for rounding, exactly on it, and anywhere.
        const Vec3 inside = 0.25 * a + 0.25 * b + 0.5 * c;
        for (const auto& [origin, p] : {std::pair(inside, a), std::pair(a, a), std::pair(vector(), a)}) {
            const double side = plane_side(origin, p, b, c);
            ASSERT_EQ((side > 0.0) - (side < 0.0), volume(origin, p, b, c).sign());
            on_plane += side == 0.0 ? 1 : 0;
        }
    }
    EXPECT_GT(on_plane, 1900);
}

TEST(ExactNormal, IsTheCrossProduct) {
    Numbers numbers;
    for (int i = 0; i < 2000; ++i) {
        const int spread = i % 2 == 0 ? 3 : 500;
        const Vec3 a = numbers.vector(-spread, std::min(spread, 127));
        const Vec3 b = numbers.vector(-spread, std::min(spread, 127));
        const Vec3 c = i % 3 == 0 ? a : numbers.vector(-spread, std::min(spread, 127));
        const Vec3 n = exact_normal(a, b, c);
        Fraction wanted[3];
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 unit(0.0);
            unit[axis] = 1.0;
            wanted[axis] = determinant(unit, a, b, c);
        }
        ASSERT_EQ(n == Vec3(0.0), oracle::has_no_area(a, b, c));
        if (n == Vec3(0.0)) continue;
        const int major = std::fabs(n.x) > std::fabs(n.y) ? (std::fabs(n.x) > std::fabs(n.z) ? 0 : 2)
                                                          : (std::fabs(n.y) > std::fabs(n.z) ? 1 : 2);
        EXPECT_EQ(n[major] < 0.0, wanted[major] < 0);
        for (int axis = 0; axis < 3; ++axis) {
            if (std::fabs(n[axis]) < 0x1p-900 && wanted[axis] != 0) continue;
            EXPECT_LE(relative_error(n[axis], n[major], wanted[axis] / wanted[major]), 0x1p-50);
        }
    }
}

// Twice the area of a triangle in a plane.
Fraction area(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (oracle::exact(b.x) - oracle::exact(a.x)) * (oracle::exact(c.y) - oracle::exact(a.y)) -
           (oracle::exact(b.y) - oracle::exact(a.y)) * (oracle::exact(c.x) - oracle::exact(a.x));
}

TEST(Orientation, HasTheExactSign) {
    Numbers numbers;
    int signs[3] = {0, 0, 0};
    const auto check = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
        const Fraction wanted = area(a, b, c);
        const int sign = wanted > 0 ? 1 : wanted < 0 ? -1 : 0;
        ++signs[sign + 1];
        ASSERT_EQ(orientation(a, b, c), sign);
        ASSERT_EQ(orientation(b, c, a), sign);
        ASSERT_EQ(orientation(b, a, c), -sign);
    };
    for (int i = 0; i < 30000; ++i) {
        const int low = i % 3 == 0 ? -1074 : i % 3 == 1 ? -8 : -150;
        const int high = i % 3 == 0 ? 1020 : i % 3 == 1 ? 0 : 60;
        const Vec2 a(numbers.vector(low, high));
        const Vec2 b(numbers.vector(low, high));
        check(a, b, Vec2(numbers.vector(low, high)));
        const Vec2 middle = 0.5 * a + 0.5 * b; // next to the line, or on it
        check(a, b, middle);
        check(a, b, Vec2(std::nextafter(middle.x, infinity), middle.y));
        check(a, b, Vec2(std::nextafter(middle.x, -infinity), middle.y));
        check(a, Vec2(a.x, b.y), Vec2(a.x, middle.y));
        check(a, a, b);
        const Vec2 whole(std::ldexp(std::floor(a.x), -40), std::ldexp(std::floor(a.y), -40));
        if (i % 3 == 1) check(whole, whole * 3.0, whole * -5.0);
    }
    for (const int count : signs) EXPECT_GT(count, 30000);
}

} // namespace
} // namespace raywise
