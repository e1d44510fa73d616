// A better binary tree of the same leaves: nodes are taken out and put back where they cost less.
#pragma once

#include "accel/bvh/build/build.h"
#include "accel/bvh/build/costs.h"
#include "base/parallel.h"

#include <cstdint>
#include <functional>

namespace raywise {

// At most so many passes over the tree; one that takes off less than this part of the tree's cost is the last.
inline constexpr int most_reinsertion_passes = 4;
inline constexpr double least_reinsertion_gain = 0.01;

// After Bittner, Hapala and Havran 2013, "Fast Insertion-Based Optimization of Bounding Volume Hierarchies", and Meister and
// Bittner 2018, "Parallel Reinsertion for Bounding Volume Hierarchy Optimization": in each pass all threads search the best
// place of each node in the tree as it is; then one thread moves them, the largest gain first, where it is still a gain
// after what has moved before. So every move lowers the cost of the tree, and the tree does not depend on the number of
// threads. Leaves and their boxes stay as they are; the boxes above become the tightest around them.
//
// Returns what the tree costs then: half areas of inner nodes and leaves, times the costs of a step and of a leaf's blocks.
// report: called with 0 now and then, so that a build can be stopped.
double optimise_by_reinsertion(BvhTree& tree, const TreeCosts& costs, const Parallel& parallel,
                               const std::function<void(std::uint64_t)>& report);

} // namespace raywise
