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

inline bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

inline double max_component(const Vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

} // namespace raywise
