// Where to split many primitives: the best of a few planes between bins of equal width, by how many boxes begin and end in each bin (Shevtsov,
// Soupikov and Kapustin 2007, "Highly Parallel Fast KD-tree Construction for Interactive Ray Tracing of Dynamic Scenes"), and of the planes
// that cut off empty space. Large nodes are judged by a sample (as Hunt, Mark and Stoll 2006, "Fast kd-tree Construction with an Adaptive
// Error-Bounded Heuristic", judge by few planes).
#pragma once

#include "accel/bvh/build/bounds.h"
#include "accel/kdtree/build/costs.h"
#include "accel/kdtree/build/task.h"

namespace raywise {

KdPlane find_binned_plane(const BuildItem* items, const KdTask& task, const KdCosts& costs);

} // namespace raywise
