// What a kd-tree is built of: the boxes of all primitives that can be hit.
#pragma once

#include "accel/accel.h"
#include "accel/bvh/build/bounds.h"
#include "base/page_array.h"
#include "ray/scene_frame.h"

#include <functional>

namespace raywise {

// In the order of primitives; id: the primitive. Boxes are in the frame, rounded outwards but for what lies below the normal numbers.
// report: called with numbers of primitives that are done.
PageVector<BuildItem> gather_kd_items(const BuildInput& input, const SceneFrame& frame,
                                      const std::function<void(std::uint64_t)>& report);

} // namespace raywise
