#include "accel/bvh_refit.h"

#include "accel/bvh_build_references.h"
#include "accel/scene_frame.h"

#include <algorithm>
#include <vector>

namespace raywise {
namespace {

Bounds bounds_of(const BvhNode& node) {
    return {Lanes{node.planes[0][0], node.planes[0][1], node.planes[0][2], 0.0f},
            Lanes{node.planes[1][0], node.planes[1][1], node.planes[1][2], 0.0f}};
}

void set_bounds(BvhNode& node, const Bounds& bounds) {
    for (int axis = 0; axis < 3; ++axis) {
        node.planes[0][axis] = bounds.lower[axis];
        node.planes[1][axis] = bounds.upper[axis];
    }
}

bool is_empty(const Bounds& bounds) { return bounds.lower[0] > bounds.upper[0]; }

// Of the primitives that can be hit; empty when none can.
Bounds leaf_bounds(const BvhTree& tree, const BvhNode& leaf, const Primitives& primitives) {
    Box box;
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
        const std::uint32_t primitive = tree.references[leaf.first + i];
        if (primitives.is_hittable(primitive)) box.extend(primitives.box(primitive));
    }
    if (box.empty()) return Bounds::none();
    const BoxF rounded = round_outwards({box.lower - tree.center, box.upper - tree.center});
    return {Lanes{rounded.lower.x, rounded.lower.y, rounded.lower.z, 0.0f},
            Lanes{rounded.upper.x, rounded.upper.y, rounded.upper.z, 0.0f}};
}

bool holds_all_hittable(const BvhTree& tree, const Primitives& primitives) {
    std::vector<bool> held(primitives.count(), false);
    for (const std::uint32_t primitive : tree.references) held[primitive] = true;
    for (std::uint32_t i = 0; i < primitives.count(); ++i) {
        if (primitives.is_hittable(i) && !held[i]) return false;
    }
    return true;
}

Bounds union_of(const BvhPair& pair) {
    Bounds both = bounds_of(pair.child[0]);
    both.extend(bounds_of(pair.child[1]));
    return both;
}

// A node in which nothing can be hit any more becomes a point of its parent's box, so that no box is infinite.
void fill_empty(BvhPair& pair, const BvhNode& parent) {
    const Lanes corner = bounds_of(parent).lower;
    for (BvhNode& child : pair.child) {
        if (is_empty(bounds_of(child))) set_bounds(child, {corner, corner});
    }
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

bool refit(BvhTree& tree, const BuildInput& input) {
    const Primitives& primitives = input.primitives;
    if (!holds_all_hittable(tree, primitives)) return false;
    if (tree.empty()) return true;
    if (primitives.hittable_count() == 0) {
        tree = BvhTree{};
        return true;
    }
    tree.center = SceneFrame::choose_center(primitives.bounds());
    input.parallel.for_blocks(tree.pairs.size(), 4096, [&](std::uint64_t begin, std::uint64_t end) {
        for (std::uint64_t i = begin; i < end; ++i) {
            for (BvhNode& node : tree.pairs[i].child) {
                if (node.is_leaf()) set_bounds(node, leaf_bounds(tree, node, primitives));
            }
        }
    });
    // Children have higher numbers than their parents.
    for (std::size_t i = tree.pairs.size(); i-- > 0;) {
        for (BvhNode& node : tree.pairs[i].child) {
            if (!node.is_leaf()) set_bounds(node, union_of(tree.pairs[node.first]));
        }
    }
    if (tree.root.is_leaf()) {
        set_bounds(tree.root, leaf_bounds(tree, tree.root, primitives));
        return true;
    }
    set_bounds(tree.root, union_of(tree.pairs[tree.root.first]));
    fill_empty(tree.pairs[tree.root.first], tree.root);
    for (const BvhPair& pair : tree.pairs) {
        for (const BvhNode& node : pair.child) {
            if (!node.is_leaf()) fill_empty(tree.pairs[node.first], node);
        }
    }
    return true;
}

} // namespace raywise
