#include "ray/cell_ray.h"

namespace raywise {

void CellRay::move(const Vec3& center, double size, double largest_extent) {
    const double distance = max_component(magnitudes(start - center));
    if (!(distance < 0x1p60 * size)) { // so far away that the line passes anywhere
        base_ = std::numeric_limits<double>::infinity();
        return;
    }
    // Twice: the first step is as near as the steps of s allow, which are 2^-52 of it, and rounded by 2^-53 of what is left.
    const double length2 = glm::dot(direction, direction);
    for (int step = 0; step < 2; ++step) {
        const double s = -glm::dot(start - center, direction) / length2;
        for (int axis = 0; axis < 3; ++axis) start[axis] = std::fma(s, direction[axis], start[axis]);
        moved_ += s;
    }
    const double start_error = 0x1p-51 * max_component(magnitudes(start)) + 0x1p-103 * distance;
    // An axis without movement keeps its coordinate.
    for (int axis = 0; axis < 3; ++axis)
        plane_error[axis] = direction[axis] == 0.0 ? 0.0 : start_error / std::fabs(direction[axis]);
    base_ = 0x1p-27 * largest_extent + 0x1p-46 * std::fabs(moved_);
}

} // namespace raywise
