// What trees look like: bounds that hold whatever the scene, and what a good tree has to look like where that is known.
#include "accel/kdtree/build/build.h"

#include "accel/grid_kd_testing.h"
#include "geometry/triangle_box_overlap.h"

#include <algorithm>

namespace raywise {
namespace {

using namespace grid_kd_testing;

struct Shape {
    int depth = 0;
    std::size_t leaves = 0;
    std::size_t references = 0;
};

Shape shape_of(const KdTreeData& tree, std::uint32_t node = 0) {
    const KdNode& n = tree.nodes[node];
    if (n.is_leaf()) return {0, 1, n.count()};
    const Shape a = shape_of(tree, n.child());
    const Shape b = shape_of(tree, n.child() + 1);
    return {1 + std::max(a.depth, b.depth), a.leaves + b.leaves, a.references + b.references};
}

void expect_bounded(World& world, const KdTreeOptions& options) {
    const KdTreeData tree = build_kd_tree(world.input(), options);
    const std::uint64_t hittable = world.primitives().hittable_count();
    if (hittable == 0) {
        EXPECT_TRUE(tree.nodes.empty());
        return;
    }
    const Shape shape = shape_of(tree);
    EXPECT_LE(shape.depth, 8.0 + 1.3 * std::log2(static_cast<double>(hittable)));
    EXPECT_LE(shape.references, 8 * hittable + 64);
    EXPECT_EQ(shape.references, tree.references.size());
    EXPECT_EQ(2 * shape.leaves - 1, tree.nodes.size());
}

// Steps cost next to nothing.
KdTreeOptions deep_trees() {
    KdTreeOptions options;
    options.test_cost = 1000.0;
    options.step_cost = 0.001;
    options.tested_at_once = 1;
    return options;
}

class KdTreeBuildOf : public ::testing::TestWithParam<NamedSoup> {};

TEST_P(KdTreeBuildOf, IsBounded) {
    World world(GetParam().make());
    expect_bounded(world, {});
    KdTreeOptions options = deep_trees();
    expect_bounded(world, options);
    options.most_bad_splits = 3;
    expect_bounded(world, options);
    options.most_exact = 0;
    expect_bounded(world, options);
    for (const KdSplit split : {KdSplit::median, KdSplit::middle}) {
        options.split = split;
        expect_bounded(world, options);
    }
}

bool meets(const Corners& corners, const Box& cell) {
    ClippedTriangle part(corners);
    for (int axis = 0; axis < 3; ++axis) {
        part.clip(axis, cell.lower[axis], cell.upper[axis]);
        if (part.empty()) return false;
    }
    return true;
}

void expect_all_referenced(const World& world, const KdTreeData& tree, const Box& cell, std::uint32_t node) {
    const KdNode& n = tree.nodes[node];
    if (!n.is_leaf()) {
        Box below = cell;
        Box above = cell;
        below.upper[n.axis()] = above.lower[n.axis()] = static_cast<double>(n.split());
        expect_all_referenced(world, tree, below, n.child());
        expect_all_referenced(world, tree, above, n.child() + 1);
        return;
    }
    // A little smaller: what only touches a plane may be on its other side.
    const Vec3 rim = 1e-9 * cell.size();
    const Box inner{cell.lower + rim, cell.upper - rim};
    const auto begin = tree.references.begin() + n.first();
    for (std::uint32_t i = 0; i < world.primitives().count(); ++i) {
        if (!world.primitives().is_hittable(i)) continue;
        Corners corners = world.primitives().corners(i);
        for (Vec3& corner : corners) corner = tree.frame.to_frame(corner);
        if (meets(corners, inner)) {
            EXPECT_EQ(std::count(begin, begin + n.count(), i), 1) << i;
        }
    }
}

TEST(KdTreeBuild, PutsEveryPrimitiveInEveryLeafThatItMeets) {
    for (const Soup& soup :
         {random_soup(300, 0.1, 51), sticks(), cubes(3), moved(sticks(), 1.0, Vec3(1e6, 0.0, 3.0))}) {
        World world(soup);
        for (const std::uint32_t most_exact : {0u, 64u, 256u}) {
            KdTreeOptions options = deep_trees();
            options.most_exact = most_exact;
            options.step_cost = 10.0;
            const KdTreeData tree = build_kd_tree(world.input(), options);
            Box bounds = tree.frame.relative(world.bounds());
            for (Vec3* corner : {&bounds.lower, &bounds.upper}) *corner *= tree.frame.scale();
            expect_all_referenced(world, tree, bounds, 0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, KdTreeBuildOf, ::testing::ValuesIn(hard_scenes()),
                         [](const auto& scene) { return scene.param.name; });

TEST(KdTreeBuild, IsTheSameForAnyNumberOfThreads) {
    const Soup soup = random_soup(30000, 0.02, 41);
    World one(soup, 1);
    const KdTreeData a = build_kd_tree(one.input());
    for (const unsigned threads : {2u, 5u}) {
        World other(soup, threads);
        const KdTreeData b = build_kd_tree(other.input());
        ASSERT_EQ(a.nodes.size(), b.nodes.size());
        EXPECT_EQ(std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(KdNode)), 0);
        EXPECT_EQ(a.references, b.references);
    }
}

TEST(KdTreeBuild, EndsWithAMillionEqualTriangles) {
    World world(Soup(1000000, {Vec3(0, 0, 0), Vec3(1, 0, 0.5), Vec3(0, 1, 0.25)}));
    for (const int bad_splits : {0, 2}) {
        KdTreeOptions options;
        options.most_bad_splits = bad_splits;
        const Shape shape = shape_of(build_kd_tree(world.input(), options));
        EXPECT_EQ(shape.references, 1000000u); // nothing parts them
    }
}

TEST(KdTreeBuild, PartsAHundredThousandInOnePointFromTheRest) {
    Soup soup = moved(random_soup(100000, 0.01, 45), 1e-9, Vec3(0.5));
    const Soup rest = random_soup(1000, 0.01, 46);
    soup.insert(soup.end(), rest.begin(), rest.end());
    World world(soup);
    const Shape shape = shape_of(build_kd_tree(world.input()));
    // Their boxes are of one or two of the numbers that planes can lie on, so that they end up in few leaves, but not in many of them.
    EXPECT_LT(shape.references, 2 * soup.size());
    EXPECT_GT(shape.leaves, 100u);
}

TEST(KdTreeBuild, PutsEveryPrimitiveOfCubesInFewLeaves) {
    World world(cubes(8));
    KdTreeOptions options;
    options.tested_at_once = 1;
    // Planes through whole coordinates cut no face.
    EXPECT_LE(shape_of(build_kd_tree(world.input(), options)).references, 2 * world.primitives().count());
}

TEST(KdTreeBuild, ClipsDiagonalTriangles) {
    // One large triangle across a scene of small ones: far from it, its box must not count.
    Soup soup = random_soup(2000, 0.01, 43);
    soup.push_back({Vec3(0, 0, 0), Vec3(1, 0, 1), Vec3(0, 1, 1)});
    World world(soup);
    const auto last = static_cast<std::uint32_t>(soup.size() - 1);
    const auto leaves_with_it = [&](bool clips) {
        KdTreeOptions options;
        options.test_cost = 50.0;
        options.step_cost = 1.0;
        options.clips = clips;
        const KdTreeData tree = build_kd_tree(world.input(), options);
        return std::count(tree.references.begin(), tree.references.end(), last);
    };
    EXPECT_GT(leaves_with_it(true), 10);
    EXPECT_LT(leaves_with_it(true), leaves_with_it(false) / 2);
}

TEST(KdTreeBuild, CutsOffEmptySpace) {
    // Two clusters far apart: between them there is a leaf of nothing.
    const Soup soup = joined(random_soup(200, 0.01, 47), moved(random_soup(200, 0.01, 48), 1.0, Vec3(10.0, 0.0, 0.0)));
    World world(soup);
    const auto empty_leaves = [&](double bonus) {
        KdTreeOptions options;
        options.empty_bonus = bonus;
        const KdTreeData tree = build_kd_tree(world.input(), options);
        return std::count_if(tree.nodes.begin(), tree.nodes.end(),
                             [](const KdNode& node) { return node.is_leaf() && node.count() == 0; });
    };
    EXPECT_GT(empty_leaves(0.2), 0);
    EXPECT_GT(empty_leaves(0.8), empty_leaves(0.0));
}

TEST(KdTreeBuild, SplitsInTheMiddleWhereToldTo) {
    World world(cubes(4));
    KdTreeOptions options;
    options.split = KdSplit::middle;
    const KdTreeData tree = build_kd_tree(world.input(), options);
    const Box bounds = tree.frame.relative(world.bounds());
    const KdNode& root = tree.nodes.front();
    ASSERT_FALSE(root.is_leaf());
    EXPECT_EQ(static_cast<double>(root.split()), bounds.center()[root.axis()] * tree.frame.scale());
    EXPECT_EQ(root.axis(), bounds.longest_axis());
}

TEST(KdTreeBuild, HalvesThePrimitivesWhereToldTo) {
    World world(random_soup(1000, 1e-4, 49));
    KdTreeOptions options;
    options.split = KdSplit::median;
    const KdTreeData tree = build_kd_tree(world.input(), options);
    ASSERT_FALSE(tree.nodes.front().is_leaf());
    for (const std::uint32_t side : {0u, 1u}) { // and what further planes cut
        const std::size_t references = shape_of(tree, tree.nodes.front().child() + side).references;
        EXPECT_GE(references, 499u);
        EXPECT_LE(references, 600u);
    }
}

} // namespace
} // namespace raywise
