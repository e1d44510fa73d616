// The order of a hierarchy's references along a space-filling curve.
#pragma once

#include "accel/bvh_build_bounds.h"
#include "accel/bvh_build_memory.h"
#include "base/parallel.h"

#include <cstdint>

namespace raywise {

struct MortonKey {
    std::uint32_t code;
    std::uint32_t index; // of the item
};

// The items in the order of the Morton codes of their centroids: neighbours in it are mostly close together. Items that
// the grid of codes cannot tell apart are put in order on a finer one, as often as it takes, so that the order is as
// good where all the detail is in a small corner. Items at the same place stay as they were.
BuildArray<MortonKey> morton_order(const BuildItem* items, std::uint32_t count, const Bounds& centroids,
                                          const Parallel& parallel);

} // namespace raywise
