// The textbooks' splits, which look at no costs: through the middle of the cell, or through the median of the primitives.
#pragma once

#include "accel/bvh/build/bounds.h"
#include "accel/kdtree/build/task.h"
#include "accel/kdtree/options.h"

namespace raywise {

// Of KdSplit::median or KdSplit::middle. items: their order changes. None where the cell has no room for a plane.
KdPlane find_plain_plane(BuildItem* items, const KdTask& task, KdSplit split);

} // namespace raywise
