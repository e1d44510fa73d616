// The inner loops of the top-down builder, compiled for each instruction set. All give the same.
#pragma once

#include "accel/bvh/build/bins.h"

#include <cstdint>

namespace raywise {

void fill_bins(const BuildItem* items, std::uint32_t count, const Binning& binning, Bins& bins);

// bounds: of all items in the bins.
BinSplit best_split(const Bins& bins, const Bounds& bounds, const TreeCosts& costs);

// Moves the items of the split's left side to the front and returns how many they are. Keeps the order on both sides,
// neither of which may be empty. scratch: room for the right side. Receives the bounds of the centroids on each side.
std::uint32_t partition_items(BuildItem* items, std::uint32_t count, const Binning& binning, const BinSplit& split,
                              BuildItem* scratch, Bounds& left_centroids, Bounds& right_centroids);

} // namespace raywise
