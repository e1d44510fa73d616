#include "ray/nearest_point.h"

#include <cmath>

namespace raywise {

double move_to_nearest(Vec3& start, const Vec3& direction, const Vec3& center) {
    const double s = -glm::dot(start - center, direction) / glm::dot(direction, direction);
    for (int axis = 0; axis < 3; ++axis) start[axis] = std::fma(s, direction[axis], start[axis]);
    return s;
}

} // namespace raywise
