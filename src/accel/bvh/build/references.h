// What every builder of a hierarchy begins with: a box around each primitive that can be hit.
#pragma once

#include "accel/accel.h"
#include "accel/bvh/build/bounds.h"
#include "accel/bvh/build/morton.h"
#include "base/page_array.h"
#include "ray/scene_frame.h"

#include <cstdint>
#include <functional>

namespace raywise {

struct BuildReferences {
    PageArray<BuildItem> items; // id: the primitive; in the order of primitives
    PageArray<MortonKey> keys;  // codes by a grid over most of them, one for each item
    std::uint32_t count = 0;
    Bounds bounds = Bounds::none();
};

// Boxes are relative to the frame's center, not scaled. most: a box around most primitives (accel/dense_region.h). report: called with numbers of
// primitives that are done.
BuildReferences gather_references(const BuildInput& input, const SceneFrame& frame, const Box& most,
                                  const std::function<void(std::uint64_t)>& report);

} // namespace raywise
