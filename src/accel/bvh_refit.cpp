#include "accel/bvh_refit.h"

#include "accel/bvh_build_bounds.h"

namespace raywise {
namespace {

Bounds bounds_of(const BvhNode& node) {
    return {Lanes{node.planes[0][0], node.planes[0][1], node.planes[0][2], 0.0f},
            Lanes{node.planes[1][0], node.planes[1][1], node.planes[1][2], 0.0f}};
}

} // namespace

double tree_cost(const BvhTree& tree, const TreeCosts& costs) {
    if (tree.empty()) return 0.0;
    const double root = bounds_of(tree.root).half_area();
    if (!(root > 0.0)) return tree.root.is_leaf() ? costs.leaf(tree.root.count) : costs.node;
    const auto cost = [&](const BvhNode& node) {
        return bounds_of(node).half_area() / root * (node.is_leaf() ? costs.leaf(node.count) : costs.node);
    };
    double sum = cost(tree.root);
    for (const BvhPair& pair : tree.pairs) sum += cost(pair.child[0]) + cost(pair.child[1]);
    return sum;
}

} // namespace raywise
