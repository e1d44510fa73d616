#include "accel/bvh/build/kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/bvh/build/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// What this calls is inlined, and so compiled for the instruction set as well: with three operands and without copies a
// build takes an eighth fewer instructions. There are four lanes everywhere, and the same operations in the same order.
HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {

void fill_bins(const BuildItem* items, std::uint32_t count, const Binning& binning, Bins& bins) {
    for (std::uint32_t i = 0; i < count; ++i) bins.add(items[i], binning);
}

BinSplit best_split(const Bins& bins, const Bounds& bounds, const TreeCosts& costs) {
    return bins.best_split(bounds, costs);
}

template <int axis>
std::uint32_t partition_along(BuildItem* items, std::uint32_t count, const Binning& binning, int bin,
                              BuildItem* scratch, Bounds& left_centroids, Bounds& right_centroids) {
    const Lanes border = fill_lanes(static_cast<float>(bin));
    // The centroid met last on each side is met again where the next one is on the other; so there has to be one at
    // first.
    Lanes last[2];
    for (const std::int32_t side : {0, -1}) {
        std::uint32_t i = 0;
        while ((binning.position(Bounds::of(items[i]).centroid()) < border)[axis] != side) ++i;
        last[side + 1] = Bounds::of(items[i]).centroid();
    }
    Lanes last_left = last[0];
    Lanes last_right = last[1];
    Bounds left_bounds{last_left, last_left};
    Bounds right_bounds{last_right, last_right};
    // Without a jump that depends on the item: every item is written to both places, and only one of the two moves on.
    BuildItem* left = items;
    BuildItem* right = scratch;
    for (std::uint32_t i = 0; i < count; ++i) {
        const BuildItem item = items[i];
        *left = item;
        *right = item;
        const Lanes centroid = Bounds::of(item).centroid();
        const IntLanes below_on_axes = binning.position(centroid) < border;
        const IntLanes below = __builtin_shufflevector(below_on_axes, below_on_axes, axis, axis, axis, axis);
        left -= below[0]; // -1: true
        right += 1 + below[0];
        last_left = select(below, centroid, last_left);
        last_right = select(below, last_right, centroid);
        left_bounds.extend({last_left, last_left});
        right_bounds.extend({last_right, last_right});
    }
    std::copy(scratch, right, left);
    left_centroids = left_bounds;
    right_centroids = right_bounds;
    return static_cast<std::uint32_t>(left - items);
}

std::uint32_t partition_items(BuildItem* items, std::uint32_t count, const Binning& binning, const BinSplit& split,
                              BuildItem* scratch, Bounds& left_centroids, Bounds& right_centroids) {
    const auto along = split.axis == 0 ? partition_along<0> : split.axis == 1 ? partition_along<1> : partition_along<2>;
    return along(items, count, binning, split.bin, scratch, left_centroids, right_centroids);
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(fill_bins);
HWY_EXPORT(best_split);
HWY_EXPORT(partition_items);

void fill_bins(const BuildItem* items, std::uint32_t count, const Binning& binning, Bins& bins) {
    HWY_DYNAMIC_DISPATCH(fill_bins)(items, count, binning, bins);
}

BinSplit best_split(const Bins& bins, const Bounds& bounds, const TreeCosts& costs) {
    return HWY_DYNAMIC_DISPATCH(best_split)(bins, bounds, costs);
}

std::uint32_t partition_items(BuildItem* items, std::uint32_t count, const Binning& binning, const BinSplit& split,
                              BuildItem* scratch, Bounds& left_centroids, Bounds& right_centroids) {
    return HWY_DYNAMIC_DISPATCH(partition_items)(items, count, binning, split, scratch, left_centroids,
                                                 right_centroids);
}

} // namespace raywise
#endif
