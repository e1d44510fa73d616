// The parts of triangles in cells: "perfect splits" (Havran 2000, section 4.3; Wald and Havran 2006, section 4.2).
#pragma once

#include "accel/bvh/build/bounds.h"
#include "base/box.h"
#include "geometry/primitives.h"
#include "geometry/triangle_box_overlap.h"
#include "ray/scene_frame.h"

#include <cstdint>

namespace raywise {

// Rounded outwards.
Bounds rounded_bounds(const Box& box);

class KdClipper {
public:
    // clips: whether parts are looked for, or boxes of whole primitives cut.
    KdClipper(const Primitives& primitives, const SceneFrame& frame, bool clips)
        : primitives_(primitives), frame_(frame), clips_(clips) {}

    // The boxes of the parts of a primitive in a cell, on either side of a plane through it. All in the frame.
    SideBoxes clip(std::uint32_t primitive, const Box& cell, int axis, double plane) const;

private:
    const Primitives& primitives_;
    const SceneFrame& frame_;
    const bool clips_;
};

} // namespace raywise
