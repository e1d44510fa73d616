// Parts of the items a hierarchy is built of, and how they are cut in two.
#pragma once

#include "accel/bvh/build/bins.h"
#include "accel/bvh/build/bounds.h"
#include "accel/bvh/build/costs.h"

#include <cstdint>
#include <utility>

namespace raywise {

// A node to be built: items [begin, end), whose primitives are references from `first` on.
struct Part {
    std::uint32_t begin;
    std::uint32_t end;
    std::uint32_t first;
    std::uint32_t primitives;
    int depth;
    Bounds bounds;
    Bounds centroids; // bounds of the items' centroids

    std::uint32_t count() const { return end - begin; }
};

// The two sides of a cut, the left one first.
using Halves = std::pair<Part, Part>;

class PartSplitter {
public:
    // scratch: room for as many items as a part has. max_depth: no part that has to be split lies as deep.
    PartSplitter(BuildItem* items, BuildItem* scratch, const TreeCosts& costs, int max_depth)
        : items_(items), scratch_(scratch), costs_(costs), max_depth_(max_depth) {}

    // Cuts a part of more than one item in two, unless it is better off as a leaf.
    bool split(const Part& part, Halves& halves) const;

    // A split by the heuristic may leave nearly all items on one side. It is allowed as long as halving from there on
    // would still end in time: depth + log2(count) <= max_depth holds for the root and for the children of every node,
    // because halving lowers the logarithm by one where depth + 1 would exceed the bound. So a node at max_depth has one
    // item.
    bool must_halve(const Part& part) const;
    // In the middle of the sorted centroids; where they all coincide, of the numbers.
    Halves halve(const Part& part) const;
    Halves divide(const Part& part, const BinSplit& split, const Binning& binning) const;

private:
    bool worth_splitting(const Part& part, const BinSplit& split) const;

    BuildItem* const items_;
    BuildItem* const scratch_;
    const TreeCosts& costs_;
    const int max_depth_;
};

} // namespace raywise
