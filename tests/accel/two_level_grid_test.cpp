#include "accel/grid/two_level_grid.h"

#include "accel/grid_kd_testing.h"

#include <cstring>

namespace raywise {
namespace {

using namespace grid_kd_testing;

class TwoLevelGridOn : public ::testing::TestWithParam<NamedSoup> {};

TEST_P(TwoLevelGridOn, AnswersAsTheLinearScan) {
    World world(GetParam().make());
    const TwoLevelGrid grid(world.input());
    expect_scan_answers(world, grid, 111);
}

// Inner grids wherever there can be some, and lists instead of gathered corners.
TEST_P(TwoLevelGridOn, AnswersAsTheLinearScanWithManyInnerGrids) {
    World world(GetParam().make());
    TwoLevelOptions options;
    options.coarse_density = 0.02;
    options.density = 4.0;
    options.most_in_a_cell = 2;
    BuildInput input = world.input();
    input.rays = 1;
    const TwoLevelGrid grid(input, options);
    EXPECT_EQ(grid.levels().inner.empty(), world.primitives().hittable_count() <= 2);
    expect_scan_answers(world, grid, 112);
}

INSTANTIATE_TEST_SUITE_P(Scenes, TwoLevelGridOn, ::testing::ValuesIn(hard_scenes()),
                         [](const auto& scene) { return scene.param.name; });

TEST(TwoLevelGrid, AnswersAsTheLinearScanForNextToAxisParallelRays) {
    expect_scan_answers_next_to_axes<TwoLevelGrid>();
}

Soup teapot_in_a_stadium() {
    return joined(moved(random_soup(5000, 0.05, 51), 1e-3, Vec3(0.3, 0.0, 0.2)), moved(cubes(1), 1.0, Vec3(0.0)));
}

// All detail is in one coarse cell; the ground that it stands on stays out of that cell's grid, whose cells are so as small as the detail.
TEST(TwoLevelGrid, KeepsTheGroundOutOfWhatStandsOnIt) {
    World world(teapot_in_a_stadium());
    const TwoLevelGrid grid(world.input());
    const TwoLevels& levels = grid.levels();
    ASSERT_FALSE(levels.inner.empty());
    EXPECT_LE(levels.inner.size(), 8u);
    std::uint64_t fullest = 0;
    for (const InnerGrid& inner : levels.inner) {
        EXPECT_LE(max_component(inner.lattice.bounds.size()), 0.0012);
        for (std::uint64_t i = 0; i < inner.lattice.number_count; ++i)
            fullest = std::max<std::uint64_t>(fullest, levels.lists.count(inner.first_cell + i));
    }
    EXPECT_LE(fullest, 60u);
    expect_scan_answers(world, grid, 113);
}

TEST(TwoLevelGrid, IsTheSameForAnyNumberOfThreads) {
    const Soup soup = joined(random_soup(30000, 0.01, 31), moved(random_soup(10000, 0.01, 32), 0.05, Vec3(0.4)));
    World one(soup, 1);
    World two(soup, 2);
    const TwoLevelGrid a(one.input());
    const TwoLevelGrid b(two.input());
    EXPECT_EQ(a.bytes(), b.bytes());
    const auto same = [](const auto& x, const auto& y) {
        return x.bytes() == y.bytes() && std::memcmp(x.data(), y.data(), x.bytes()) == 0;
    };
    EXPECT_TRUE(same(a.levels().own.blocks, b.levels().own.blocks));
    EXPECT_TRUE(same(a.levels().own.narrow_offsets, b.levels().own.narrow_offsets));
    EXPECT_TRUE(same(a.levels().lists.blocks, b.levels().lists.blocks));
    EXPECT_TRUE(same(a.levels().lists.narrow_offsets, b.levels().lists.narrow_offsets));
    EXPECT_TRUE(same(a.levels().inner_of, b.levels().inner_of));
}

TEST(TwoLevelGrid, LimitsItsReferences) {
    World world(random_soup(5000, 2.0, 33)); // all of them reach through the whole scene
    const TwoLevelGrid grid(world.input());
    const std::uint64_t most = 24u * 5000u + 65536u;
    EXPECT_LE(grid.levels().own.offset(grid.levels().coarse.number_count), most);
    EXPECT_LE(grid.levels().lists.blocks.size(), most * 80u);
}

TEST(TwoLevelGrid, StaysWithinTheMemoryLimitAsFarAsItCan) {
    World world(joined(random_soup(5000, 0.02, 37), moved(random_soup(5000, 0.02, 38), 0.01, Vec3(0.4))));
    BuildInput input = world.input();
    const std::size_t unlimited = TwoLevelGrid(input).bytes();
    for (const double part : {0.5, 0.1, 0.06}) {
        input.memory_limit = static_cast<std::uint64_t>(part * static_cast<double>(unlimited));
        const TwoLevelGrid grid(input);
        EXPECT_LE(grid.bytes(), input.memory_limit) << part;
        expect_scan_answers(world, grid, 114);
    }
    input.memory_limit = 1;
    EXPECT_EQ(TwoLevelGrid(input).levels().coarse.cell_count(), 1u);
}

TEST(TwoLevelGrid, BearsAMillionEqualTriangles) { expect_bears_a_million_equal_triangles<TwoLevelGrid>(); }

TEST(TwoLevelGrid, StopsWhenAsked) { expect_stops_when_asked<TwoLevelGrid>(4); }

TEST(TwoLevelGrid, ReportsProgressFromZeroToOne) { expect_progress_from_zero_to_one<TwoLevelGrid>(); }

} // namespace
} // namespace raywise
