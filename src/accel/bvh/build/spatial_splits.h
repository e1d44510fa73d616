// A builder from above, in which primitives may be cut in two.
#pragma once

#include "accel/bvh/build/build.h"
#include "accel/bvh/build/costs.h"
#include "accel/bvh/build/references.h"

#include <cstdint>
#include <functional>

namespace raywise {

// So many references may be added by cutting, as a part of the primitives.
inline constexpr double split_budget = 0.2;

// Splits from above by the surface area heuristic, down to leaves. Where the boxes of the two sides would overlap, a plane
// through the node is tried as well; primitives on both sides of it are referenced twice, each time by the box of what is on
// that side, unless they had better be on one side only (Stich, Friedrich and Dietrich 2009, "Spatial Splits in Bounding
// Volume Hierarchies"). A node may add references in proportion to how many it has, so that the tree does not depend on the
// order of work. budget: of references to add, as a part of the primitives; 0: nothing is cut.
// report: called with numbers of primitives that are done, twice each.
void build_with_spatial_splits(BuildReferences references, double budget, const BuildInput& input,
                               const TreeCosts& costs, const std::function<void(std::uint64_t)>& report, BvhTree& tree);

} // namespace raywise
