#include "accel/kdtree/treelet_cuts.h"

#include "accel/kdtree/treelets.h"
#include "base/page_array.h"

#include <algorithm>
#include <array>

namespace raywise {
namespace {

struct Cell {
    std::uint32_t node;
    float lower[3];
    float upper[3];

    float half_area() const {
        const float x = upper[0] - lower[0];
        const float y = upper[1] - lower[1];
        const float z = upper[2] - lower[2];
        return x * y + y * z + z * x;
    }
};

PageVector<float> areas_of(const KdTreeData& tree, const BoxF& bounds) {
    PageVector<float> areas(tree.nodes.size());
    PageVector<Cell> waiting{
        {0, {bounds.lower.x, bounds.lower.y, bounds.lower.z}, {bounds.upper.x, bounds.upper.y, bounds.upper.z}}};
    while (!waiting.empty()) {
        Cell below = waiting.back();
        waiting.pop_back();
        areas[below.node] = below.half_area();
        const KdNode& node = tree.nodes[below.node];
        if (node.is_leaf()) continue;
        Cell above = below;
        below.node = node.child();
        above.node = node.child() + 1;
        below.upper[node.axis()] = above.lower[node.axis()] = node.split();
        waiting.push_back(above);
        waiting.push_back(below);
    }
    return areas;
}

} // namespace

TreeletCuts::TreeletCuts(const KdTreeData& tree, const BoxF& bounds) : cuts_(tree.nodes.size()) {
    const PageVector<float> areas = areas_of(tree, bounds);
    // What a subtree costs when the treelet above has so many levels left for it; with none, it begins one of its own.
    PageVector<std::array<float, treelet_levels>> costs(tree.nodes.size());
    // Children have higher numbers than their parents.
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        const KdNode& node = tree.nodes[i];
        if (node.is_leaf()) continue; // costs nothing
        const auto& below = costs[node.child()];
        const auto& above = costs[node.child() + 1];
        const float own = areas[i] + below[treelet_levels - 1] + above[treelet_levels - 1];
        costs[i][0] = own;
        for (int levels = 1; levels < treelet_levels; ++levels) {
            const auto left = static_cast<std::size_t>(levels);
            const float shared = below[left - 1] + above[left - 1];
            costs[i][left] = std::min(own, shared);
            if (own < shared) cuts_[i] = static_cast<std::uint8_t>(cuts_[i] | 1u << levels);
        }
    }
}

} // namespace raywise
