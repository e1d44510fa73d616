// The kd-tree's answers, however it is built. What trees look like: kd_tree_build_test.cpp and kd_tree_treelets_test.cpp.
#include "accel/kdtree/kd_tree.h"

#include "accel/grid_kd_testing.h"
#include "geometry/every_target.h"

namespace raywise {
namespace {

using namespace grid_kd_testing;

class KdTreeOn : public ::testing::TestWithParam<NamedSoup> {};

TEST_P(KdTreeOn, AnswersAsTheLinearScan) {
    World world(GetParam().make());
    const KdTree tree(world.input());
    expect_scan_answers(world, tree, 201);
}

// Trees as deep as they get, as steps cost next to nothing, and shallow ones.
TEST_P(KdTreeOn, AnswersAsTheLinearScanWithAnotherBalanceOfCosts) {
    World world(GetParam().make());
    world.costs = {1000.0, 0.1};
    const KdTree deep(world.input());
    expect_scan_answers(world, deep, 202);
    world.costs = {1.0, 1000.0};
    const KdTree shallow(world.input());
    expect_scan_answers(world, shallow, 203);
}

INSTANTIATE_TEST_SUITE_P(Scenes, KdTreeOn, ::testing::ValuesIn(hard_scenes()),
                         [](const auto& scene) { return scene.param.name; });

// Larger scenes say no more about each way to build.
constexpr std::size_t most_for_all = 300;

struct NamedOptions {
    const char* name;
    KdTreeOptions options;
};

// Each with steps so cheap that there are many planes.
template <class T>
NamedOptions with(const char* name, T KdTreeOptions::*option, T value) {
    KdTreeOptions options;
    options.test_cost = 80.0;
    options.step_cost = 1.0;
    options.*option = value;
    return {name, options};
}

class KdTreeBuilt : public ::testing::TestWithParam<NamedOptions> {};

TEST_P(KdTreeBuilt, AnswersAsTheLinearScan) {
    for (const NamedSoup& scene : hard_scenes()) {
        SCOPED_TRACE(scene.name);
        World world(scene.make());
        if (world.soup().size() > most_for_all) continue;
        const KdTree tree(world.input(), GetParam().options);
        expect_scan_answers(world, tree, 204);
        if (HasFailure()) return;
    }
}

INSTANTIATE_TEST_SUITE_P(Switches, KdTreeBuilt,
                         ::testing::Values(with("median", &KdTreeOptions::split, KdSplit::median),
                                           with("middle", &KdTreeOptions::split, KdSplit::middle),
                                           with("one_by_one", &KdTreeOptions::tested_at_once, 1u),
                                           with("no_bonus", &KdTreeOptions::empty_bonus, 0.0),
                                           with("large_bonus", &KdTreeOptions::empty_bonus, 0.8),
                                           with("bad_refines", &KdTreeOptions::most_bad_splits, 3),
                                           with("not_clipped", &KdTreeOptions::clips, false),
                                           with("bins_to_the_leaves", &KdTreeOptions::most_exact, 0u),
                                           with("all_exact", &KdTreeOptions::most_exact, 100000u),
                                           with("few_references", &KdTreeOptions::most_references_per_primitive, 1u),
                                           with("no_tree", &KdTreeOptions::most_numbers, std::uint64_t{1})),
                         [](const auto& options) { return std::string(options.param.name); });

TEST(KdTree, AnswersAsTheLinearScanForNextToAxisParallelRays) { expect_scan_answers_next_to_axes<KdTree>(); }

// Enough primitives for parts that are built apart and joined.
TEST(KdTree, AnswersAsTheLinearScanWhenBuiltInParts) {
    World world(random_soup(9000, 0.02, 42));
    const KdTree tree(world.input());
    expect_scan_answers(world, tree, 205);
}

TEST(KdTree, AnswersTheSameWithEveryInstructionSet) {
    for (const Soup& soup :
         {random_soup(100, 1.0, 4), cubes(4), bad_company(), sticks(), needle(),
          moved(random_soup(100, 0.05, 14), 1e30, Vec3(0.0)), moved(cubes(3), 0.125, Vec3(5e6, 3e6, -4e6))}) {
        World world(soup);
        world.costs = {80.0, 1.0};
        const KdTree tree(world.input());
        on_every_target([&] {
            if (!HasFailure()) expect_scan_answers(world, tree, 206);
        });
    }
}

// Planes at zero and through zero, rays in them: nothing of a distance is left to be moved outwards.
TEST(KdTree, FindsWhatLiesInThePlanesThatARayRunsIn) {
    Soup soup;
    for (int i = -8; i < 8; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            Corners c{Vec3(0.0), Vec3(0.0), Vec3(0.0)};
            c[0][(axis + 1) % 3] = i;
            c[1][(axis + 1) % 3] = i + 1;
            c[2][(axis + 2) % 3] = i;
            soup.push_back(c);
            for (Vec3& p : c) p[axis] += 1.0;
            soup.push_back(c);
        }
    }
    World world(soup);
    world.costs = {80.0, 0.1};
    const KdTree tree(world.input());
    std::size_t hits = 0;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double tiny : {0.0, -0.0, 5e-324, -1e-300, 1e-200, -1e-130, 1e-40}) {
            for (int i = -9; i <= 9; ++i) {
                for (const double start : {-20.0, 20.0, 0.25, 0.0}) {
                    Ray ray{Vec3(0.0), -unbounded, Vec3(tiny), unbounded};
                    ray.origin[(axis + 1) % 3] = 0.5 * i;
                    ray.origin[axis] = start;
                    ray.direction[axis] = start > 0.0 ? -1.0 : 1.0;
                    hits += compare_with_windows(world, tree, ray);
                }
            }
        }
    }
    EXPECT_GT(hits, 1000u);
}

TEST(KdTree, AsksFloatRaysAsThoseOfDouble) {
    World world(rounded_to_float(random_soup(1500, 0.05, 7)));
    const KdTree tree(world.input());
    Dice dice(3);
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const RayF ray{Vec3f(dice.in(world.bounds())), i % 2 == 0 ? 0.0f : -1.0f, Vec3f(dice.unit()), 2.0f};
        const PrimitiveHit hit = tree.closest_f32(ray, {});
        EXPECT_TRUE(bits_equal(hit, tree.closest(widened(ray), {})));
        EXPECT_EQ(tree.any_f32(ray, {}), hit.is_hit());
        hits += hit.is_hit() ? 1 : 0;
    }
    EXPECT_GT(hits, 500);
}

TEST(KdTree, StopsWhenAsked) {
    for (const int last : {1, 3, 5}) {
        int calls = 0;
        World world(random_soup(100000, 0.01, 44), 2, [&](double, const char*) { return ++calls == last; });
        EXPECT_THROW(KdTree(world.input()), Error);
    }
}

TEST(KdTree, ReportsProgressFromZeroToOne) { expect_progress_from_zero_to_one<KdTree>(); }

TEST(KdTree, TakesLessThanItWantsWhereMemoryIsShort) {
    Soup soup;
    for (int i = 0; i < 20; ++i) soup = joined(soup, moved(sticks(), 1.0, 0.01 * Vec3(i, i % 3, i % 7)));
    World world(soup);
    const KdTree free(world.input());
    BuildInput input = world.input();
    input.memory_limit = free.bytes() * 2 / 3;
    const KdTree bounded(input);
    EXPECT_LE(bounded.bytes(), input.memory_limit);
    expect_scan_answers(world, bounded, 207);
    input.memory_limit = 1; // no tree is so small
    const KdTree smallest(input);
    EXPECT_LE(smallest.bytes(), bounded.bytes());
    expect_scan_answers(world, smallest, 208);
}

} // namespace
} // namespace raywise
