// What the tests of builders ask of a tree that rays are traced in.
#pragma once

#include "accel/bvh/node.h"
#include "accel/bvh/write.h"
#include "accel/bvh_testing.h"

#include <cstring>
#include <set>

namespace raywise::bvh_testing {

// Every hittable triangle with its coordinates in a leaf, boxes around what is in them, tight.
inline void expect_sound(const WideBvh& tree, const Primitives& primitives) {
    std::multiset<std::uint32_t> found;
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
            const WideNode& node = tree.nodes[n];
            if (is_empty_child(node, i)) continue;
            WideNode expected;
            const NodeRef child = node.child[i];
            if (child.is_leaf()) {
                Box box;
                const auto read = [&](const auto& block) {
                    for (std::uint32_t k = 0; k < block.n; ++k) {
                        found.insert(block.id(k));
                        EXPECT_EQ(block.corners(k), primitives.corners(block.id(k)));
                        for (const Vec3& p : primitives.corners(block.id(k))) box.extend(p);
                    }
                };
                if (tree.is_float64) {
                    for_each_block<double>(tree, child, read);
                } else {
                    for_each_block<float>(tree, child, read);
                }
                Box relative = tree.frame.relative(box);
                relative.lower *= tree.frame.scale();
                relative.upper *= tree.frame.scale();
                const BoxF rounded = round_outwards(relative);
                const Bounds around{Lanes{rounded.lower.x, rounded.lower.y, rounded.lower.z, 0.0f},
                                    Lanes{rounded.upper.x, rounded.upper.y, rounded.upper.z, 0.0f}};
                set_box(expected, i, leaf_box(around, max_component(Vec3(rounded.upper) - Vec3(rounded.lower))));
            } else {
                ASSERT_GT(child.index(), n) << "parents come before their children";
                set_box_around(expected, i, tree.nodes[child.index()]);
            }
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_EQ(node.planes[axis][0][i], expected.planes[axis][0][i]) << n;
                ASSERT_EQ(node.planes[axis][1][i], expected.planes[axis][1][i]) << n;
            }
        }
    }
    ASSERT_EQ(std::set<std::uint32_t>(found.begin(), found.end()).size(), primitives.hittable_count());
    for (const std::uint32_t primitive : found) ASSERT_TRUE(primitives.is_hittable(primitive));
}

inline void expect_same_tree(const WideBvh& a, const WideBvh& b) {
    EXPECT_EQ(a.is_float64, b.is_float64);
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    ASSERT_EQ(a.blocks.size(), b.blocks.size());
    for (std::size_t n = 0; n < a.nodes.size(); ++n) {
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_EQ(a.nodes[n].planes[axis][0][i], b.nodes[n].planes[axis][0][i]);
                ASSERT_EQ(a.nodes[n].planes[axis][1][i], b.nodes[n].planes[axis][1][i]);
            }
        }
        ASSERT_EQ(std::memcmp(a.nodes[n].child, b.nodes[n].child, sizeof a.nodes[n].child), 0);
    }
    EXPECT_EQ(std::memcmp(a.blocks.data(), b.blocks.data(), a.blocks.bytes()), 0);
}

} // namespace raywise::bvh_testing
