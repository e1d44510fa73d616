// Where a kd-tree is cut into treelets.
#pragma once

#include "accel/kdtree/build/binary_tree.h"
#include "base/box.h"
#include "base/page_array.h"

#include <cstdint>

namespace raywise {

// For each inner node, when a treelet that has come down to it ends and a new one begins with it.
class TreeletCuts {
public:
    // So that rays come to as few treelets as can be: of all ways to cut the tree, the one with the least sum of the surfaces of the cells that
    // treelets begin with. Filled from above to their full three levels, many would begin with the last plane of a branch.
    // bounds: of the root's cell.
    TreeletCuts(const KdTreeData& tree, const BoxF& bounds);

    // levels: that the treelet has left for it and what is below, at least one.
    bool begins(std::uint32_t node, int levels) const { return (cuts_[node] >> levels & 1u) != 0; }

private:
    PageVector<std::uint8_t> cuts_; // bits, by how many levels are left
};

} // namespace raywise
