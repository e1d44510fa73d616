// What the tests of builders ask of a tree.
#pragma once

#include "accel/bvh/binary_traversal.h"
#include "accel/bvh/build/bounds.h"
#include "accel/bvh/build/build.h"
#include "accel/bvh/build/costs.h"
#include "accel/bvh_testing.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace raywise::bvh_testing {

struct TreeShape {
    int depth = 0;
    std::uint32_t largest_leaf = 0;
    std::uint64_t references = 0;
    std::uint64_t leaves = 0;

    double fill() const { return static_cast<double>(references) / static_cast<double>(leaves); }
};

inline void add_shape(const BvhTree& tree, const BvhNode& node, int depth, TreeShape& shape) {
    shape.depth = std::max(shape.depth, depth);
    if (node.is_leaf()) {
        shape.largest_leaf = std::max(shape.largest_leaf, node.count);
        shape.references += node.count;
        ++shape.leaves;
        return;
    }
    for (const BvhNode& child : tree.pairs[node.first].child) {
        if (!child.is_leaf()) {
            EXPECT_GT(child.first, node.first);
        }
        add_shape(tree, child, depth + 1, shape);
    }
}

inline TreeShape shape_of(const BvhTree& tree) {
    TreeShape shape;
    add_shape(tree, tree.root, 0, shape);
    return shape;
}

// What a ray that meets the root is taken to cost, in the unit of the costs: the surface area heuristic over the whole tree.
inline double tree_cost(const BvhTree& tree, const TreeCosts& costs) {
    const auto cost = [&](const BvhNode& node) {
        return bounds_of(node).half_area() / bounds_of(tree.root).half_area() *
               (node.is_leaf() ? costs.leaf(node.count) : costs.node);
    };
    double sum = cost(tree.root);
    for (const BvhPair& pair : tree.pairs) sum += cost(pair.child[0]) + cost(pair.child[1]);
    return sum;
}

inline bool contains(const BvhNode& outer, const BvhNode& inner) {
    for (int axis = 0; axis < 3; ++axis) {
        if (inner.planes[0][axis] < outer.planes[0][axis] || inner.planes[1][axis] > outer.planes[1][axis])
            return false;
    }
    return true;
}

// Leaves take up the references one after the other; boxes hold their children. Counts each leaf's references.
inline bool is_well_formed(const BvhTree& tree, const BvhNode& node, std::vector<int>& uses) {
    if (node.is_leaf()) {
        for (std::uint32_t i = 0; i < node.count; ++i) ++uses.at(node.first + i);
        return true;
    }
    for (const BvhNode& child : tree.pairs.at(node.first).child) {
        if (!contains(node, child) || !is_well_formed(tree, child, uses)) return false;
    }
    return true;
}

// Depth, sizes of leaves, boxes within boxes, every hittable primitive in exactly one leaf and within its box.
inline void expect_valid_tree(const BvhTree& tree, const Primitives& primitives, std::uint32_t max_leaf_size) {
    const TreeShape shape = shape_of(tree);
    EXPECT_LE(shape.depth, bvh_max_depth);
    EXPECT_LE(shape.largest_leaf, max_leaf_size);
    EXPECT_EQ(shape.references, tree.references.size());
    ASSERT_EQ(tree.references.size(), primitives.hittable_count());
    std::vector<int> uses(tree.references.size(), 0);
    EXPECT_TRUE(is_well_formed(tree, tree.root, uses));
    EXPECT_TRUE(std::all_of(uses.begin(), uses.end(), [](int n) { return n == 1; }));
    auto sorted = tree.references;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_TRUE(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());

    std::uint64_t outside = 0;
    const auto check = [&](const BvhNode& node) {
        for (std::uint32_t i = 0; node.is_leaf() && i < node.count; ++i) {
            for (const Vec3& corner : primitives.corners(tree.references[node.first + i])) {
                for (int axis = 0; axis < 3; ++axis) {
                    const double at = corner[axis] - tree.frame.center()[axis];
                    if (at < static_cast<double>(node.planes[0][axis]) ||
                        at > static_cast<double>(node.planes[1][axis]))
                        ++outside;
                }
            }
        }
    };
    check(tree.root);
    for (const BvhPair& pair : tree.pairs) {
        check(pair.child[0]);
        check(pair.child[1]);
    }
    EXPECT_EQ(outside, 0u);
}

inline bool same_node(const BvhNode& a, const BvhNode& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

inline void expect_same_tree(const BvhTree& a, const BvhTree& b) {
    EXPECT_EQ(a.references, b.references);
    EXPECT_TRUE(same_node(a.root, b.root));
    ASSERT_EQ(a.pairs.size(), b.pairs.size());
    for (std::size_t i = 0; i < a.pairs.size(); ++i) {
        ASSERT_TRUE(same_node(a.pairs[i].child[0], b.pairs[i].child[0])) << i;
        ASSERT_TRUE(same_node(a.pairs[i].child[1], b.pairs[i].child[1])) << i;
    }
}

// The tree with the interface of a structure.
class TreeAccel final : public TraversedAccel<TreeAccel> {
public:
    TreeAccel(const BuildInput& input, const BvhTree& tree) : TraversedAccel(input.primitives), tree_(tree) {}
    std::size_t bytes() const override { return tree_.bytes(); }
    template <class Collector>
    void traverse(const ExactRay& ray, Collector& collector) const {
        const CellRay cell_ray(ray, primitives().bounds(), primitives().largest_extent());
        if (!cell_ray.is_known()) return test_all_primitives(primitives(), ray, collector);
        traverse_boxes(tree_, cell_ray, [&](const BvhNode& leaf, double& last) {
            if (test_primitives(primitives(), ray, &tree_.references[leaf.first], leaf.count, collector)) return true;
            last = cell_ray.upper_end(collector.limit());
            return false;
        });
    }

private:
    const BvhTree& tree_;
};

// The closest hit by the tree against the linear scan's.
inline void expect_closest(Scene& scene, const BvhTree& tree, const Ray& ray) {
    if (!ray.is_traceable()) return;
    const TreeAccel accel(scene.input(), tree);
    EXPECT_TRUE(same_hit(oracle::PlainScan(scene.input()).closest(ray, {}), accel.closest(ray, {}))) << text_of(ray);
}

} // namespace raywise::bvh_testing
