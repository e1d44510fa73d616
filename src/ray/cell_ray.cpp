#include "ray/cell_ray.h"

#include "ray/nearest_point.h"

namespace raywise {

void CellRay::move(const Vec3& center, double distance, double size, double largest_extent) {
    if (!(distance < 0x1p60 * size)) { // so far away that the line passes anywhere
        base_ = std::numeric_limits<double>::infinity();
        return;
    }
    for (int step = 0; step < 2; ++step) moved_ += move_to_nearest(start, direction, center);
    const double start_error = 0x1p-51 * max_component(magnitudes(start)) + 0x1p-103 * distance;
    // An axis without movement keeps its coordinate.
    for (int axis = 0; axis < 3; ++axis)
        plane_error[axis] = direction[axis] == 0.0 ? 0.0 : start_error / std::fabs(direction[axis]);
    base_ = 0x1p-27 * largest_extent + 0x1p-46 * std::fabs(moved_);
}

} // namespace raywise
