// What a binary tree is worth.
#pragma once

#include "accel/bvh_build.h"
#include "accel/bvh_build_costs.h"

namespace raywise {

// What a ray that meets the root is taken to cost, in the unit of the costs: the surface area heuristic over the whole
// tree. Zero for a tree without anything in it.
double tree_cost(const BvhTree& tree, const TreeCosts& costs);

} // namespace raywise
