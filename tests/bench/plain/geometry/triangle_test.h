// Stands in for src/geometry/triangle_test.h in libraywise-plain, to tell what exactness costs: the test of Moeller and
// Trumbore 1997 ("Fast, Minimum Storage Ray-Triangle Intersection") in float64. Without an epsilon, which would only make it
// reject more, and dividing last, which is faster than their way of dividing first where triangles are seen from both sides. It
// leaks at edges; nobody's answers come from here.
#pragma once

#include "ray/ray.h"
#include "base/vec.h"
#include "geometry/exact.h"

#include <algorithm>
#include <cmath>

namespace raywise {

struct TriangleHit {
    double t;
    double u;
    double v;
};

inline bool test_triangle(const PreparedRay& ray, const Vec3& a, const Vec3& b, const Vec3& c, TriangleHit& hit) {
    const Vec3 e1 = b - a;
    const Vec3 e2 = c - a;
    const Vec3 p = glm::cross(ray.direction, e2);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0.0) return false;
    const double size = std::fabs(determinant);
    const double sign = std::copysign(1.0, determinant);
    const Vec3 s = ray.origin - a;
    const double u = sign * glm::dot(s, p);
    if (u < 0.0 || u > size) return false;
    const Vec3 q = glm::cross(s, e1);
    const double v = sign * glm::dot(ray.direction, q);
    if (v < 0.0 || u + v > size) return false;
    const double inverse = 1.0 / size;
    hit = {sign * glm::dot(e2, q) * inverse, u * inverse, v * inverse};
    return true;
}

} // namespace raywise
