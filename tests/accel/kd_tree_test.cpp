#include "accel/kdtree/kd_tree.h"

#include "accel/grid_kd_testing.h"

#include <algorithm>

namespace raywise {
namespace {

using namespace grid_kd_testing;

class KdTreeOn : public ::testing::TestWithParam<NamedSoup> {};

TEST_P(KdTreeOn, AnswersAsTheLinearScan) {
    World world(GetParam().make());
    const KdTree tree(world.input());
    expect_scan_answers(world, tree, 201);
}

// Trees as deep as they get: steps cost next to nothing.
TEST_P(KdTreeOn, AnswersAsTheLinearScanWithAnotherBalanceOfCosts) {
    World world(GetParam().make());
    world.costs = {1000.0, 0.1};
    const KdTree deep(world.input());
    expect_scan_answers(world, deep, 202);
    world.costs = {1.0, 1000.0};
    const KdTree shallow(world.input());
    expect_scan_answers(world, shallow, 203);
}

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

TEST_P(KdTreeOn, IsBounded) {
    World world(GetParam().make());
    world.costs = {1000.0, 0.001};
    const KdTree tree(world.input());
    const std::uint64_t hittable = world.primitives().hittable_count();
    if (hittable == 0) {
        EXPECT_TRUE(tree.data().nodes.empty());
        return;
    }
    const Shape shape = shape_of(tree.data());
    EXPECT_LE(shape.depth, 8.0 + 1.3 * std::log2(static_cast<double>(hittable)));
    EXPECT_LE(shape.references, 8 * hittable + 64);
    EXPECT_EQ(2 * shape.leaves - 1, tree.data().nodes.size());
}

INSTANTIATE_TEST_SUITE_P(Scenes, KdTreeOn, ::testing::ValuesIn(hard_scenes()),
                         [](const auto& scene) { return scene.param.name; });

TEST(KdTree, AnswersAsTheLinearScanForNextToAxisParallelRays) { expect_scan_answers_next_to_axes<KdTree>(); }

TEST(KdTree, IsTheSameForAnyNumberOfThreads) {
    const Soup soup = random_soup(30000, 0.02, 41);
    World one(soup, 1);
    World two(soup, 2);
    const KdTree a(one.input());
    const KdTree b(two.input());
    ASSERT_EQ(a.data().nodes.size(), b.data().nodes.size());
    EXPECT_EQ(std::memcmp(a.data().nodes.data(), b.data().nodes.data(), a.data().nodes.size() * sizeof(KdNode)), 0);
    EXPECT_EQ(a.data().references, b.data().references);
}

// Enough primitives for parts that are built apart and joined.
TEST(KdTree, AnswersAsTheLinearScanWhenBuiltInParts) {
    World world(random_soup(9000, 0.02, 42));
    const KdTree tree(world.input());
    expect_scan_answers(world, tree, 204);
}

TEST(KdTree, PutsEveryPrimitiveOfCubesInFewLeaves) {
    World world(cubes(8));
    const KdTree tree(world.input());
    // Planes through whole coordinates cut no face.
    EXPECT_LE(shape_of(tree.data()).references, 2 * world.primitives().count());
}

TEST(KdTree, ClipsDiagonalTriangles) {
    // One large triangle across a scene of small ones: far from it, its box must not count.
    Soup soup = random_soup(2000, 0.01, 43);
    soup.push_back({Vec3(0, 0, 0), Vec3(1, 0, 1), Vec3(0, 1, 1)});
    World world(soup);
    world.costs = {100.0, 1.0};
    const KdTree tree(world.input());
    const auto last = static_cast<std::uint32_t>(soup.size() - 1);
    std::size_t leaves_with_it = 0;
    std::size_t leaves = 0;
    for (const KdNode& node : tree.data().nodes) {
        if (!node.is_leaf()) continue;
        ++leaves;
        if (node.count() == 1) {
            leaves_with_it += node.first() == last ? 1 : 0;
        } else {
            const auto begin = tree.data().references.begin() + node.first();
            leaves_with_it += static_cast<std::size_t>(std::count(begin, begin + node.count(), last));
        }
    }
    EXPECT_GT(leaves_with_it, 10u);
    EXPECT_LT(leaves_with_it, leaves / 5);
}

TEST(KdTree, StopsWhenAsked) {
    for (const int last : {1, 3, 5}) {
        int calls = 0;
        World world(random_soup(100000, 0.01, 44), 2, [&](double, const char*) { return ++calls == last; });
        EXPECT_THROW(KdTree(world.input()), Error);
    }
}

TEST(KdTree, ReportsProgressFromZeroToOne) {
    std::vector<double> fractions;
    World world(random_soup(50000, 0.01, 44), 1, [&](double fraction, const char*) {
        fractions.push_back(fraction);
        return false;
    });
    const KdTree tree(world.input());
    ASSERT_GE(fractions.size(), 4u);
    for (std::size_t i = 0; i < fractions.size(); ++i) {
        EXPECT_GE(fractions[i], i == 0 ? 0.0 : fractions[i - 1]);
        EXPECT_LE(fractions[i], 1.0);
    }
}

} // namespace
} // namespace raywise
