#include "accel/bvh/build/parts.h"

#include "accel/bvh/build/kernels.h"

#include <algorithm>

namespace raywise {
namespace {

int ceil_log2(std::uint32_t n) {
    int log = 0;
    while (log < 32 && (std::uint64_t{1} << log) < n) ++log;
    return log;
}

// A child that is still as large as its parent.
Part child_of(const Part& part, const Bounds& bounds) {
    return {part.begin, part.end, part.first, part.primitives, part.depth + 1, bounds, Bounds::none()};
}

void number(const Part& part, std::uint32_t left_primitives, Halves& halves) {
    halves.first.primitives = left_primitives;
    halves.second.first = part.first + left_primitives;
    halves.second.primitives = part.primitives - left_primitives;
}

} // namespace

bool PartSplitter::split(const Part& part, Halves& halves) const {
    const bool may_be_leaf = part.primitives <= costs_.max_leaf_size;
    if (may_be_leaf && costs_.blocks(part.primitives) == 1) return false;
    if (must_halve(part)) {
        if (may_be_leaf) return false;
        halves = halve(part);
        return true;
    }
    const Binning binning(part.centroids, Bins::count_for(part.count()));
    Bins bins(binning.count());
    fill_bins(items_ + part.begin, part.count(), binning, bins);
    const BinSplit split = best_split(bins, part.bounds, costs_);
    if (may_be_leaf && !worth_splitting(part, split)) return false;
    halves = split.axis == no_axis ? halve(part) : divide(part, split, binning);
    return true;
}

bool PartSplitter::must_halve(const Part& part) const { return part.depth + ceil_log2(part.count()) >= max_depth_; }

bool PartSplitter::worth_splitting(const Part& part, const BinSplit& split) const {
    if (split.axis == no_axis) return false;
    const double unit = static_cast<double>(part.bounds.reciprocal_size());
    const double area = part.bounds.half_area() * unit * unit; // as the split's weight
    return costs_.node * area + costs_.block * static_cast<double>(split.weight) < costs_.leaf(part.primitives) * area;
}

Halves PartSplitter::divide(const Part& part, const BinSplit& split, const Binning& binning) const {
    Halves halves{child_of(part, split.left), child_of(part, split.right)};
    const std::uint32_t left = partition_items(items_ + part.begin, part.count(), binning, split, scratch_,
                                               halves.first.centroids, halves.second.centroids);
    halves.first.end = halves.second.begin = part.begin + left;
    number(part, split.left_primitives, halves);
    return halves;
}

Halves PartSplitter::halve(const Part& part) const {
    const int axis = longest_axis(part.centroids);
    const std::uint32_t middle = part.begin + part.count() / 2;
    std::nth_element(items_ + part.begin, items_ + middle, items_ + part.end,
                     [axis](const BuildItem& a, const BuildItem& b) {
                         const float ca = a.centroid(axis);
                         const float cb = b.centroid(axis);
                         return ca < cb || (ca == cb && (a.id < b.id || (a.id == b.id && a.count < b.count)));
                     });
    Halves halves{child_of(part, Bounds::none()), child_of(part, Bounds::none())};
    halves.first.end = halves.second.begin = middle;
    std::uint32_t left_primitives = 0;
    for (std::uint32_t i = part.begin; i < middle; ++i) left_primitives += items_[i].count;
    for (Part* const half : {&halves.first, &halves.second}) {
        for (std::uint32_t i = half->begin; i < half->end; ++i) {
            half->bounds.extend(Bounds::of(items_[i]));
            half->centroids.extend(Bounds::of_centroid(items_[i]));
        }
    }
    number(part, left_primitives, halves);
    return halves;
}

} // namespace raywise
