// As plain/geometry/triangle_test.h, in float32: what most libraries run. The corners still come as float64 and are converted,
// which costs it a little.
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
    const Vec3f origin(ray.origin);
    const Vec3f direction(ray.direction);
    const Vec3f corner(a);
    const Vec3f e1 = Vec3f(b) - corner;
    const Vec3f e2 = Vec3f(c) - corner;
    const Vec3f p = glm::cross(direction, e2);
    const float determinant = glm::dot(e1, p);
    if (determinant == 0.0F) return false;
    const float inverse = 1.0F / determinant;
    const Vec3f s = origin - corner;
    const float u = glm::dot(s, p) * inverse;
    if (u < 0.0F || u > 1.0F) return false;
    const Vec3f q = glm::cross(s, e1);
    const float v = glm::dot(direction, q) * inverse;
    if (v < 0.0F || u + v > 1.0F) return false;
    hit = {static_cast<double>(glm::dot(e2, q) * inverse), static_cast<double>(u), static_cast<double>(v)};
    return true;
}

} // namespace raywise
