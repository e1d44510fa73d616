// A tree for geometry that has moved: the same topology around new boxes.
#pragma once

#include "accel/bvh_build.h"
#include "accel/bvh_build_costs.h"

namespace raywise {

// What a ray that meets the root is taken to cost, in the unit of the costs: the surface area heuristic over the whole
// tree. Zero for a tree without anything in it.
double tree_cost(const BvhTree& tree, const TreeCosts& costs);

// Gives every node the box of what is in it now. input.primitives have the numbers that the tree was built with, at new
// places. Boxes that were cut at a split (bvh_spatial_splits.h) become those of whole primitives. Returns false, and leaves
// the tree as it was, when a primitive can be hit that is not in the tree, because it could not be hit when that was
// built: then only building helps.
//
// Boxes of what has moved apart overlap. Whoever refits compares tree_cost() before and after: at refit_limit times what it
// was when the tree was built, a new tree is worth its while.
bool refit(BvhTree& tree, const BuildInput& input);

// Twice the cost is twice the time of a ray, about: 10^6 rays at 0.5 us repay building 10^6 triangles at 0.3 us.
inline constexpr double refit_limit = 2.0;

} // namespace raywise
