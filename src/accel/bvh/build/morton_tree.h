// A wide tree straight from the order along a Morton curve (Lauterbach et al. 2009, "Fast BVH Construction on GPUs"), without a binary one.
#pragma once

#include "accel/accel.h"
#include "accel/bvh/node.h"

namespace raywise {

// A node is a range of primitives in the order of their codes (morton_ranges.h), its children what the highest digits of the codes tell apart,
// and boxes come from below. The same tree for any number of threads and every instruction set.
WideBvh build_morton_tree(const BuildInput& input);

} // namespace raywise
