#include "accel/kdtree/build/clip.h"

#include <algorithm>

namespace raywise {

Bounds rounded_bounds(const Box& box) {
    const BoxF rounded = round_outwards(box);
    return {Lanes{rounded.lower.x, rounded.lower.y, rounded.lower.z, 0.0f},
            Lanes{rounded.upper.x, rounded.upper.y, rounded.upper.z, 0.0f}};
}

// Clipping and the results are widened by `slack`. Cutting widened by what the polygon may be off keeps it that near to the exact one:
// without, a cut might lose a long edge that lies nearly in the plane. A cut is off by at most 2^-50 of the corners' coordinates, seven cuts
// follow each other, the way into the frame rounds by 2^-52, and the slack is four times that.
SideBoxes KdClipper::clip(std::uint32_t primitive, const Box& cell, int axis, double plane) const {
    Corners corners = primitives_.corners(primitive);
    for (Vec3& corner : corners) corner = frame_.to_frame(corner);
    const Box own = {glm::min(corners[0], glm::min(corners[1], corners[2])),
                     glm::max(corners[0], glm::max(corners[1], corners[2]))};
    const double slack = 0x1p-45 * std::max(max_component(glm::abs(own.lower)), max_component(glm::abs(own.upper)));
    ClippedTriangle inside(corners);
    for (int a = 0; a < 3 && clips_; ++a) {
        if (own.lower[a] < cell.lower[a] || own.upper[a] > cell.upper[a]) {
            inside.clip(a, cell.lower[a] - slack, cell.upper[a] + slack);
        }
    }
    SideBoxes boxes = clips_ ? inside.boxes_of_sides(axis, plane + slack, plane - slack) : SideBoxes{own, own};
    const auto finish = [&](Box& part, Box within) {
        if (part.empty()) return;
        for (int a = 0; a < 3; ++a) {
            // A triangle that lies flat stays so where its corners got into the frame without rounding.
            const double rounding = frame_.center()[a] == 0.0 ? 0.0 : slack;
            part.lower[a] = std::max({part.lower[a] - slack, own.lower[a] - rounding, within.lower[a]});
            part.upper[a] = std::min({part.upper[a] + slack, own.upper[a] + rounding, within.upper[a]});
        } // empty now if it only came near
    };
    Box within_below = cell;
    Box within_above = cell;
    within_below.upper[axis] = plane;
    within_above.lower[axis] = plane;
    finish(boxes.below, within_below);
    finish(boxes.above, within_above);
    return boxes;
}

} // namespace raywise
