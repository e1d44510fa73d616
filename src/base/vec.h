// Vectors: GLM's, in double precision unless the name says float. float32 data converts without loss.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace raywise {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec3f = glm::vec3;

// v[axis] for an axis known only at run time: GLM's own operator branches on it.
template <class Vector>
inline typename Vector::value_type at(const Vector& v, int axis) {
    return glm::value_ptr(v)[axis];
}

// A difference with itself is NaN where it is not zero, and so is a sum of such.
template <class T>
bool is_finite(const glm::vec<3, T>& v) {
    return (v.x - v.x) + (v.y - v.y) + (v.z - v.z) == T(0);
}

// Lexicographic.
inline bool precedes(const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// Without branches, which rays in all directions would make mispredicted: GLM's functions for double have some.
inline double larger(double a, double b) { return a > b ? a : b; }
inline double smaller(double a, double b) { return a < b ? a : b; }
inline Vec3 magnitudes(const Vec3& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }
inline Vec3 larger(const Vec3& a, const Vec3& b) { return {larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z)}; }

inline double max_component(const Vec3& v) { return larger(v.x, larger(v.y, v.z)); }

} // namespace raywise
