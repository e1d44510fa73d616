#include "accel/bvh/build/subtrees.h"

#include "accel/bvh/write.h"

#include <algorithm>
#include <cstddef>

namespace raywise {
namespace {

// Before it has a box, too: the root is nobody's child.
bool is_inner_child(const WideNode& node, std::uint32_t i) {
    return !node.child[i].is_leaf() && node.child[i].index() != 0;
}

} // namespace

WideNode empty_node() {
    WideNode node{};
    for (std::uint32_t i = 0; i < wide_bvh_width; ++i) set_empty(node, i);
    return node;
}

void fit_inner_children(WideNode* nodes, std::size_t count) {
    for (std::size_t n = count; n-- > 0;) {
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
            const NodeRef child = nodes[n].child[i];
            if (is_inner_child(nodes[n], i)) set_box_around(nodes[n], i, nodes[child.index()]);
        }
    }
}

PageArray<WideNode> assemble(std::vector<WideNode> top, std::vector<NodeSubtree>& subtrees, const Parallel& parallel) {
    std::vector<std::uint32_t> offsets;
    offsets.reserve(subtrees.size());
    std::size_t total = top.size();
    for (const NodeSubtree& subtree : subtrees) {
        offsets.push_back(static_cast<std::uint32_t>(total));
        top[subtree.parent].child[subtree.child] = NodeRef::node(offsets.back());
        total += subtree.nodes.size();
    }
    PageArray<WideNode> all(total);
    std::copy(top.begin(), top.end(), all.begin());
    parallel.for_each(subtrees.size(), [&](std::uint64_t i) {
        std::vector<WideNode>& nodes = subtrees[i].nodes;
        WideNode* const place = all.data() + offsets[i];
        std::copy(nodes.begin(), nodes.end(), place);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            for (NodeRef& child : place[k].child) {
                if (!child.is_leaf()) child = NodeRef::node(child.index() + offsets[i]);
            }
        }
        nodes = {};
    });
    fit_inner_children(all.data(), top.size());
    return all;
}

} // namespace raywise
