// The upper levels of a hierarchy, built from above over clusters of primitives.
#pragma once

#include "accel/bvh/build/build.h"
#include "accel/bvh/build/clusters.h"
#include "accel/bvh/build/costs.h"

#include <cstdint>
#include <functional>

namespace raywise {

// Splits the clusters' items by the surface area heuristic with bins until one is left, and puts the clusters' own trees
// below, or makes a leaf of several. Takes the
// clusters apart. bounds: of all items. report: called with
// numbers of primitives that are done.
void build_top_down(Clusters& clusters, const Bounds& bounds, const TreeCosts& costs, const Parallel& parallel,
                    const std::function<void(std::uint64_t)>& report, BvhTree& tree);

} // namespace raywise
