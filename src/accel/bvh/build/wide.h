// From the binary tree to the wide one.
#pragma once

#include "accel/accel.h"
#include "accel/bvh/binary_tree.h"
#include "accel/bvh/node.h"

namespace raywise {

// Reports progress from progress_begin to 1.
WideBvh widen(const BvhTree& tree, const BuildInput& input, double progress_begin);

} // namespace raywise
