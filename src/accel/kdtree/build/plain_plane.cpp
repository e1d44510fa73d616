#include "accel/kdtree/build/plain_plane.h"

#include <algorithm>

namespace raywise {

KdPlane find_plain_plane(BuildItem* items, const KdTask& task, KdSplit split) {
    KdPlane plane;
    const int axis = task.cell.longest_axis();
    plane.position = static_cast<float>(task.cell.center()[axis]);
    if (split == KdSplit::median) {
        BuildItem* const middle = items + task.count / 2;
        std::nth_element(items, middle, items + task.count, [axis](const BuildItem& a, const BuildItem& b) {
            return a.centroid(axis) < b.centroid(axis) || (a.centroid(axis) == b.centroid(axis) && a.id < b.id);
        });
        plane.position = middle->centroid(axis);
    }
    const auto position = static_cast<double>(plane.position);
    if (position > task.cell.lower[axis] && position < task.cell.upper[axis]) plane.axis = axis;
    return plane;
}

} // namespace raywise
