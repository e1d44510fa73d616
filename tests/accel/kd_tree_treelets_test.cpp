// The form that rays are traced in holds what the builder's has: the same planes around the same primitives.
#include "accel/kdtree/treelets.h"

#include "accel/grid_kd_testing.h"
#include "accel/kdtree/build/build.h"
#include "accel/kdtree/treelet_cuts.h"

#include <algorithm>
#include <map>

namespace raywise {
namespace {

using namespace grid_kd_testing;

// A leaf's cell, by its planes on the way from the root: below or above, axis and place.
using Way = std::vector<std::tuple<bool, int, float>>;
using Leaves = std::map<Way, std::vector<std::uint32_t>>;

Leaves leaves_of(const KdTreeData& tree) {
    Leaves leaves;
    const std::function<void(std::uint32_t, const Way&)> visit = [&](std::uint32_t index, const Way& way) {
        const KdNode& node = tree.nodes[index];
        if (node.is_leaf()) {
            const auto first = tree.references.begin() + node.first();
            if (node.count() > 0) leaves[way] = {first, first + node.count()};
            return;
        }
        for (const bool is_above : {false, true}) {
            Way next = way;
            next.emplace_back(is_above, node.axis(), node.split());
            visit(node.child() + (is_above ? 1 : 0), next);
        }
    };
    if (!tree.nodes.empty()) visit(0, {});
    return leaves;
}

template <class T>
std::vector<std::uint32_t> primitives_in(const std::byte* leaf, const World& world, double& farthest) {
    KdLeafHead head;
    std::memcpy(&head, leaf, sizeof head);
    leaf += sizeof head;
    std::vector<std::uint32_t> list;
    for (std::uint32_t begin = 0; begin < head.count; begin += triangle_block_size) {
        const TriangleBlock<T> block(leaf, std::min(triangle_block_size, head.count - begin));
        for (std::uint32_t i = 0; i < block.n; ++i) {
            list.push_back(block.id(i));
            EXPECT_EQ(block.corners(i), world.primitives().corners(block.id(i)));
        }
        leaf += TriangleBlock<T>::bytes_per_triangle * block.n;
    }
    farthest = static_cast<double>(head.distance);
    return list;
}

Leaves leaves_of(const KdTreelets& tree, const World& world) {
    Leaves leaves;
    const std::function<void(KdLink, const Way&)> visit = [&](KdLink link, const Way& way) {
        if (link.is_leaf()) {
            double farthest = 0.0;
            EXPECT_TRUE(tree.is_float64);
            leaves[way] = primitives_in<double>(tree.leaves.data() + link.offset(), world, farthest);
            for (const std::uint32_t primitive : leaves[way]) {
                for (const Vec3& corner : world.primitives().corners(primitive))
                    EXPECT_LE(max_component(magnitudes(corner - tree.frame.center())), farthest);
            }
            return;
        }
        const KdTreelet& treelet = tree.treelets.data()[link.index()];
        for (std::uint32_t cell = 0; cell < treelet_cells; ++cell) {
            if ((treelet.present() >> cell & 1u) == 0) continue;
            Way next = way;
            for (int level = treelet_levels; level-- > 0;) {
                const std::uint32_t plane = ((cell + treelet_cells) >> (level + 1)) - 1;
                const bool is_above = (cell >> level & 1u) != 0;
                if (treelet.split[plane] == KdTreelet::no_plane) {
                    EXPECT_FALSE(is_above);
                    continue;
                }
                next.emplace_back(is_above, treelet.axis(plane), treelet.split[plane]);
            }
            visit(treelet.cell[cell], next);
        }
    };
    if (!tree.treelets.empty()) visit(KdLink::treelet(0), {});
    return leaves;
}

class KdTreeletsOf : public ::testing::TestWithParam<NamedSoup> {};

TEST_P(KdTreeletsOf, HoldTheLeavesOfTheTree) {
    World world(GetParam().make());
    for (const double step_cost : {0.1, 5.0, 40.0}) {
        KdTreeOptions options;
        options.test_cost = 20.0;
        options.step_cost = step_cost;
        const KdTreeData tree = build_kd_tree(world.input(), options);
        const KdTreelets treelets = make_treelets(tree, world.input(), 0.9);
        EXPECT_EQ(leaves_of(tree), leaves_of(treelets, world));
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, KdTreeletsOf, ::testing::ValuesIn(hard_scenes()),
                         [](const auto& scene) { return scene.param.name; });

TEST(KdTreelets, AreOfFloatWhereAllMeshesAre) {
    const std::vector<float> vertices{0, 0, 0, 1, 0, 0, 0, 1, 0};
    TriangleArrays arrays;
    arrays.vertices = {reinterpret_cast<const std::byte*>(vertices.data()), 12, 4, Scalar::float32};
    arrays.vertex_count = 3;
    arrays.triangle_count = 1;
    const Primitives primitives({std::make_shared<const TriangleMesh>(arrays, false, false)});
    const Parallel parallel(1);
    Progress progress;
    const BuildInput input{primitives, {}, {}, parallel, progress};
    const KdTreelets tree = make_treelets(build_kd_tree(input), input, 0.9);
    EXPECT_FALSE(tree.is_float64);
    ASSERT_EQ(tree.treelets.size(), 1u);
    EXPECT_EQ(tree.treelets.data()[0].present(), 1u);
    EXPECT_EQ(tree.leaves.size(),
              sizeof(KdLeafHead) + TriangleBlock<float>::bytes_per_triangle + triangle_block_padding);
}

// A comb: each plane cuts a leaf off, so that filling treelets from above leaves nothing to choose, and three planes fit in each.
TEST(KdTreeletCuts, TakeThreeLevelsOfAComb) {
    constexpr int planes = 9;
    KdTreeData tree;
    tree.nodes.resize(1);
    std::uint32_t node = 0;
    for (int i = 0; i < planes; ++i) {
        const auto child = static_cast<std::uint32_t>(tree.nodes.size());
        tree.nodes.resize(tree.nodes.size() + 2, KdNode::leaf(0, 1));
        tree.nodes[node] = KdNode::inner(0, 1.0f - static_cast<float>(i + 1) / 16.0f, child);
        tree.nodes[child + 1] = KdNode::leaf(0, 1);
        node = child;
    }
    tree.nodes[node] = KdNode::leaf(0, 1);
    const TreeletCuts cuts(tree, {Vec3f(0.0f), Vec3f(1.0f)});
    int begun = 1;
    int levels = treelet_levels - 1;
    for (std::uint32_t next = tree.nodes[0].child(); !tree.nodes[next].is_leaf(); next = tree.nodes[next].child()) {
        const bool begins = levels == 0 || cuts.begins(next, levels);
        begun += begins ? 1 : 0;
        levels = begins ? treelet_levels - 1 : levels - 1;
    }
    EXPECT_EQ(begun, planes / treelet_levels);
}

// The root's plane cuts off a large leaf on either side of a small cell with three levels in it: filled to three levels, the treelet would take two of
// those, and leave the last planes of four branches to begin one each.
TEST(KdTreeletCuts, EndATreeletEarlyWhereThatSavesOthers) {
    KdTreeData tree;
    tree.nodes.resize(1);
    const auto split = [&](std::uint32_t node, int axis, float position) {
        const auto child = static_cast<std::uint32_t>(tree.nodes.size());
        tree.nodes.resize(tree.nodes.size() + 2, KdNode::leaf(0, 1));
        tree.nodes[child] = tree.nodes[child + 1] = KdNode::leaf(0, 1);
        tree.nodes[node] = KdNode::inner(axis, position, child);
        return child;
    };
    const std::uint32_t small = split(0, 0, 0.25f);
    const std::uint32_t halves = split(small, 1, 0.5f);
    for (const std::uint32_t half : {halves, halves + 1}) {
        const std::uint32_t quarters = split(half, 2, 0.5f);
        split(quarters, 0, 0.125f);
        split(quarters + 1, 0, 0.125f);
    }
    const TreeletCuts cuts(tree, {Vec3f(0.0f), Vec3f(1.0f)});
    EXPECT_TRUE(cuts.begins(small, treelet_levels - 1));
}

} // namespace
} // namespace raywise
