// The nodes of a wide tree that several threads make: the top by one, each subtree below it by one.
#pragma once

#include "accel/bvh/node.h"
#include "base/page_array.h"
#include "base/parallel.h"

#include <cstdint>
#include <vector>

namespace raywise {

// Subtrees up to this many triangles are made by one thread each, what is above them by one alone. It depends on nothing but the scene, and
// neither does the order of the nodes therefore.
inline constexpr std::uint32_t subtree_size = 16384;

struct NodeSubtree {
    std::uint32_t parent; // the top node it hangs below, and as which child
    std::uint32_t child;
    std::vector<WideNode> nodes; // numbered from 0, the root, on; every other one behind its parent
};

WideNode empty_node();

// Gives the inner children of nodes their boxes, which lie around those of their own children. Those are behind them and have theirs, or
// are among these nodes.
void fit_inner_children(WideNode* nodes, std::size_t count);

// The top's nodes, and behind them those of the subtrees, whose memory is given back. Fits the top.
PageArray<WideNode> assemble(std::vector<WideNode> top, std::vector<NodeSubtree>& subtrees, const Parallel& parallel);

} // namespace raywise
