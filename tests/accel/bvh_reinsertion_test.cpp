#include "accel/bvh/build/reinsertion.h"

#include "accel/bvh/build/bounds.h"
#include "accel/bvh/build/build.h"
#include "accel/bvh_testing.h"
#include "accel/bvh_tree_testing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace raywise {
namespace {

using namespace bvh_testing;

const BvhBuildOptions alone{1, 1, BuildCosts{1.0, 1.0}}; // every primitive is a leaf

double half_area(const BvhNode& node) {
    double e[3];
    for (int axis = 0; axis < 3; ++axis)
        e[axis] = static_cast<double>(node.planes[1][axis]) - static_cast<double>(node.planes[0][axis]);
    return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
}

double cost_of(const BvhTree& tree, const BvhNode& node, const TreeCosts& costs) {
    if (node.is_leaf()) return half_area(node) * costs.leaf(node.count);
    double sum = half_area(node) * costs.node;
    for (const BvhNode& child : tree.pairs[node.first].child) sum += cost_of(tree, child, costs);
    return sum;
}

// Boxes are exactly as large as what is in them.
bool is_tight(const BvhTree& tree, const BvhNode& node) {
    if (node.is_leaf()) return true;
    const BvhPair& pair = tree.pairs[node.first];
    for (int axis = 0; axis < 3; ++axis) {
        if (node.planes[0][axis] != std::min(pair.child[0].planes[0][axis], pair.child[1].planes[0][axis]))
            return false;
        if (node.planes[1][axis] != std::max(pair.child[0].planes[1][axis], pair.child[1].planes[1][axis]))
            return false;
    }
    return is_tight(tree, pair.child[0]) && is_tight(tree, pair.child[1]);
}

// Box and primitives of each leaf, in an order of their own.
using Leaf = std::pair<std::array<float, 6>, std::vector<std::uint32_t>>;
void add_leaves(const BvhTree& tree, const BvhNode& node, std::vector<Leaf>& leaves) {
    if (!node.is_leaf()) {
        for (const BvhNode& child : tree.pairs[node.first].child) add_leaves(tree, child, leaves);
        return;
    }
    Leaf leaf;
    for (std::size_t i = 0; i < 6; ++i) leaf.first[i] = node.planes[i / 3][i % 3];
    const auto begin = tree.references.begin() + node.first;
    leaf.second.assign(begin, begin + node.count);
    leaves.push_back(std::move(leaf));
}
std::vector<Leaf> leaves_of(const BvhTree& tree) {
    std::vector<Leaf> leaves;
    add_leaves(tree, tree.root, leaves);
    std::sort(leaves.begin(), leaves.end());
    return leaves;
}

// A tree of one primitive per leaf whose every node cuts the list of primitives in two at `left` of them.
template <class Left>
BvhNode make_subtree(const Primitives& primitives, const std::vector<std::uint32_t>& order, std::uint32_t begin,
                     std::uint32_t end, const Left& left, BvhTree& tree) {
    if (end - begin == 1) {
        tree.references.push_back(order[begin]);
        const BoxF box = round_outwards(primitives.box(order[begin]));
        return make_node(
            {Lanes{box.lower.x, box.lower.y, box.lower.z, 0.0f}, Lanes{box.upper.x, box.upper.y, box.upper.z, 0.0f}},
            static_cast<std::uint32_t>(tree.references.size() - 1), 1);
    }
    const auto pair = static_cast<std::uint32_t>(tree.pairs.size());
    tree.pairs.emplace_back();
    const std::uint32_t middle = begin + left(end - begin);
    const BvhNode a = make_subtree(primitives, order, begin, middle, left, tree);
    const BvhNode b = make_subtree(primitives, order, middle, end, left, tree);
    tree.pairs[pair].child[0] = a;
    tree.pairs[pair].child[1] = b;
    BvhNode node = a;
    for (int axis = 0; axis < 3; ++axis) {
        node.planes[0][axis] = std::min(a.planes[0][axis], b.planes[0][axis]);
        node.planes[1][axis] = std::max(a.planes[1][axis], b.planes[1][axis]);
    }
    node.first = pair;
    node.count = 0;
    return node;
}
template <class Left>
BvhTree make_tree(const Primitives& primitives, const std::vector<std::uint32_t>& order, const Left& left) {
    BvhTree tree;
    tree.root = make_subtree(primitives, order, 0, static_cast<std::uint32_t>(order.size()), left, tree);
    return tree;
}

std::vector<std::uint32_t> shuffled(std::size_t count, unsigned seed) {
    std::vector<std::uint32_t> order(count);
    for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
    Random random(seed);
    for (std::size_t i = count; i > 1; --i)
        std::swap(order[i - 1], order[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
    return order;
}

void nothing(std::uint64_t /*primitives*/) {}

// Optimises with one thread and with two, checks what comes out, and returns its cost as a part of what it was.
double expect_sound(Scene& scene, const BvhTree& before, const BvhBuildOptions& options) {
    const TreeCosts costs(scene.input(), options);
    BvhTree tree = before;
    BvhTree other = before;
    const double told = optimise_by_reinsertion(tree, costs, Parallel(1), nothing);
    optimise_by_reinsertion(other, costs, Parallel(2), nothing);
    expect_same_tree(tree, other);
    EXPECT_EQ(tree.pairs.size(), before.pairs.size());
    EXPECT_EQ(leaves_of(tree), leaves_of(before));
    EXPECT_TRUE(is_tight(tree, tree.root));
    EXPECT_LE(shape_of(tree).depth, bvh_max_depth);
    std::vector<int> uses(tree.references.size(), 0);
    EXPECT_TRUE(is_well_formed(tree, tree.root, uses));
    EXPECT_TRUE(std::all_of(uses.begin(), uses.end(), [](int n) { return n == 1; }));
    const double cost = cost_of(tree, tree.root, costs);
    EXPECT_NEAR(told, cost, 1e-9 * cost);
    return cost / cost_of(before, before.root, costs);
}

double expect_sound(const Triangles& triangles, unsigned seed) {
    Scene scene(triangles);
    const auto half = [](std::uint32_t n) { return n / 2; };
    return expect_sound(scene, make_tree(scene.primitives(), shuffled(triangles.size(), seed), half), alone);
}

TEST(BvhReinsertion, TreesOfRandomPairsBecomeMuchBetter) {
    EXPECT_LT(expect_sound(soup(5000, 0.01, 1), 1), 0.4);
    EXPECT_LT(expect_sound(ball(30, 2.0), 2), 0.4);
    EXPECT_LT(expect_sound(grid_of_boxes(5), 3), 0.6);
}

TEST(BvhReinsertion, GoodTreesBecomeNoWorse) {
    for (const auto& triangles : {soup(3000, 0.05, 4), ball(30, 2.0), grid_of_boxes(6), flat(20, 1, 3.0)}) {
        Scene scene(triangles);
        for (const BvhBuildOptions& options : {alone, BvhBuildOptions{8, 8, BuildCosts{1.0, 1.0}}}) {
            EXPECT_LE(expect_sound(scene, build_bvh(scene.input(), 1.0, options), options), 1.0 + 1e-12);
        }
    }
}

TEST(BvhReinsertion, FewNodes) {
    for (const std::size_t count : {1u, 2u, 3u, 4u, 5u}) EXPECT_LE(expect_sound(soup(count, 0.1, 5), 5), 1.0 + 1e-12);
    Scene scene(soup(4, 0.1, 6));
    BvhTree empty;
    EXPECT_EQ(optimise_by_reinsertion(empty, TreeCosts(scene.input(), alone), Parallel(1), nothing), 0.0);
    EXPECT_TRUE(empty.empty());
}

// Two pairs of neighbours, each node with one of another pair: one move that any of the four can make.
TEST(BvhReinsertion, FindsTheMoveThatIsThere) {
    const auto at = [](double x) { return Corners{Vec3(x, 0.0, 0.0), Vec3(x + 0.1, 0.1, 0.0), Vec3(x, 0.1, 0.1)}; };
    Scene scene({at(0.0), at(10.0), at(0.2), at(10.2), at(100.0), at(100.2)});
    const auto half = [](std::uint32_t n) { return n == 6 ? 4u : n / 2; };
    const BvhTree before = make_tree(scene.primitives(), {0, 1, 2, 3, 4, 5}, half);
    BvhTree tree = before;
    optimise_by_reinsertion(tree, TreeCosts(scene.input(), alone), Parallel(1), nothing);
    std::vector<std::vector<std::uint32_t>> pairs;
    for (const BvhPair& pair : tree.pairs) {
        if (!pair.child[0].is_leaf() || !pair.child[1].is_leaf()) continue;
        pairs.push_back({tree.references[pair.child[0].first], tree.references[pair.child[1].first]});
        std::sort(pairs.back().begin(), pairs.back().end());
    }
    std::sort(pairs.begin(), pairs.end());
    EXPECT_EQ(pairs, (std::vector<std::vector<std::uint32_t>>{{0, 2}, {1, 3}, {4, 5}}));
}

// Trees of the greatest depth: one leaf beside all others, level by level.
TEST(BvhReinsertion, DepthStaysBounded) {
    const auto one = [](std::uint32_t) { return 1u; };
    const auto last = [](std::uint32_t n) { return n - 1; };
    const std::size_t count = static_cast<std::size_t>(bvh_max_depth) + 1;
    for (unsigned seed = 0; seed < 20; ++seed) {
        Scene scene(soup(count, 0.01, seed));
        const auto order = shuffled(count, seed);
        const BvhTree tree = make_tree(scene.primitives(), order, one);
        ASSERT_EQ(shape_of(tree).depth, bvh_max_depth);
        EXPECT_LT(expect_sound(scene, tree, alone), 0.7);
        EXPECT_LT(expect_sound(scene, make_tree(scene.primitives(), order, last), alone), 0.7);
    }
    // Each box holds the one before: the best tree is the one that is there, and some moves would make it deeper.
    Triangles shells;
    for (std::size_t i = 1; i <= count; ++i) {
        const double r = std::ldexp(1.0, static_cast<int>(i));
        shells.push_back({Vec3(-r, -r, -r), Vec3(r, -r, r), Vec3(-r, r, 0.0)});
    }
    Scene scene(shells);
    for (unsigned seed = 0; seed < 20; ++seed) {
        EXPECT_LE(expect_sound(scene, make_tree(scene.primitives(), shuffled(count, seed), one), alone), 1.0 + 1e-12);
        EXPECT_LE(expect_sound(scene, make_tree(scene.primitives(), shuffled(count, seed), last), alone), 1.0 + 1e-12);
    }
}

TEST(BvhReinsertion, ScenesThatBreakBuilders) {
    const Triangles copies(3000, {Vec3(0.0), Vec3(1.0, 0.0, 0.5), Vec3(0.0, 1.0, 0.5)});
    EXPECT_EQ(expect_sound(copies, 7), 1.0) << "there is nothing to gain";
    Triangles huge = soup(3000, 0.002, 8, 1e-4);
    huge[1000] = {Vec3(-1e6, -1e6, 0.5), Vec3(1e6, -1e6, 0.5), Vec3(0.0, 1e6, 0.5)};
    EXPECT_LT(expect_sound(huge, 8), 1.0);
    Triangles slivers;
    for (int i = 0; i < 3000; ++i) slivers.push_back({Vec3(i, 0, 0), Vec3(i + 1, 0, 1e-6), Vec3(i + 0.5, 1e-6, 0)});
    EXPECT_LT(expect_sound(slivers, 9), 0.5);
    for (const double scale : {1e-38, 1e-30, 1e30, 1e37}) EXPECT_LT(expect_sound(soup(500, 0.01, 10, scale), 10), 0.6);
    const Triangles points(500, {Vec3(1.0), Vec3(1.0), Vec3(1.0)});
    Triangles with_one = points; // nothing of these can be hit but one
    with_one[7] = {Vec3(0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0)};
    Scene scene(with_one);
    EXPECT_EQ(build_bvh(scene.input(), 1.0, {8, 8, BuildCosts{1.0, 1.0}, BvhQuality::high}).references.size(), 1u);
}

TEST(BvhReinsertion, Cancels) {
    Scene scene(soup(5000, 0.01, 11));
    const auto half = [](std::uint32_t n) { return n / 2; };
    BvhTree tree = make_tree(scene.primitives(), shuffled(5000, 11), half);
    int calls = 0;
    const auto stop = [&](std::uint64_t /*primitives*/) {
        if (++calls == 7) throw Error(Status::ERROR_CANCELLED, "stop");
    };
    EXPECT_THROW(optimise_by_reinsertion(tree, TreeCosts(scene.input(), alone), Parallel(1), stop), Error);
    EXPECT_EQ(calls, 7);
}

} // namespace
} // namespace raywise
