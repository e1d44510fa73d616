// What float64 cannot settle about a triangle, answered without any rounding, whatever the exponents: in sums of doubles where those
// are exact, in integers elsewhere.
#pragma once

#include "base/vec.h"

namespace raywise {

// The weights of a triangle's corners at the point where a ray's line meets it, times one common positive or negative factor.
// a is the determinant direction . ((b - origin) x (c - origin)), and so on in cyclic order.
struct Weights {
    double a;
    double b;
    double c;
};

// Whether the line meets the triangle, edges and corners included, and is not in its plane. direction: of a ExactRay.
// The weights are then exact to a few units in the last place; otherwise they mean nothing.
bool exact_weights(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c,
                   Weights& weights);

// (a - origin) . ((b - a) x (c - a)): on which side of a triangle's plane a point is. The sign is exact, zero only on the plane.
double plane_side(const Vec3& origin, const Vec3& a, const Vec3& b, const Vec3& c);

// (b - a) x (c - a) times a power of two that brings its largest component near 1; zero exactly when the corners lie in one line.
Vec3 exact_normal(const Vec3& a, const Vec3& b, const Vec3& c);

// Which way three points of a plane turn: 1 to the left, -1 to the right, 0 when they lie in one line. Always exact.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

} // namespace raywise
