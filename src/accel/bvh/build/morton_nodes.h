// Nodes and leaves of a Morton tree, out of ranges of primitives.
#pragma once

#include "accel/bvh/build/morton_ranges.h"
#include "accel/bvh/build/subtrees.h"
#include "accel/bvh/node.h"

#include <vector>

namespace raywise {

// What becomes a node.
struct MortonPart {
    MortonRange range;
    int depth;
};

// The nodes above the subtrees, and what those are made of.
struct MortonTop {
    PageVector<WideNode> nodes;
    std::vector<NodeSubtree> subtrees;
    std::vector<MortonPart> roots;
};

// bvh: has its frame and its blocks, whose leaves are written. Subtrees can be made in any order, by any number of threads.
MortonTop make_morton_top(MortonRanges& ranges, const Primitives& primitives, WideBvh& bvh);
void make_morton_subtree(MortonRanges& ranges, const Primitives& primitives, const MortonPart& root, WideBvh& bvh,
                         PageVector<WideNode>& nodes);

} // namespace raywise
