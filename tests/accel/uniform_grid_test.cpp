#include "accel/grid/uniform_grid.h"

#include "accel/grid_kd_testing.h"

namespace raywise {
namespace {

using namespace grid_kd_testing;

class UniformGridOn : public ::testing::TestWithParam<NamedSoup> {};

TEST_P(UniformGridOn, AnswersAsTheLinearScan) {
    World world(GetParam().make());
    const UniformGrid grid(world.input());
    expect_scan_answers(world, grid, 101);
}

TEST_P(UniformGridOn, AnswersAsTheLinearScanAtOtherDensities) {
    World world(GetParam().make());
    for (const double density : {0.1, 50.0}) {
        const UniformGrid grid(world.input(), density);
        expect_scan_answers(world, grid, 102);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, UniformGridOn, ::testing::ValuesIn(hard_scenes()),
                         [](const auto& scene) { return scene.param.name; });

TEST(UniformGrid, HasNoCellsWithoutPrimitives) {
    World world({});
    const UniformGrid grid(world.input());
    EXPECT_EQ(grid.statistics().cells, 0u);
    EXPECT_EQ(grid.resolution(), (std::array<std::uint32_t, 3>{0, 0, 0}));
}

TEST(UniformGrid, AnswersAsTheLinearScanForNextToAxisParallelRays) { expect_scan_answers_next_to_axes<UniformGrid>(); }

TEST(UniformGrid, IsTheSameForAnyNumberOfThreads) {
    const Soup soup = random_soup(60000, 0.01, 31);
    World one(soup, 1);
    World two(soup, 2);
    const UniformGrid a(one.input());
    const UniformGrid b(two.input());
    EXPECT_EQ(a.bytes(), b.bytes());
    EXPECT_EQ(a.offsets(), b.offsets());
    EXPECT_EQ(a.references(), b.references());
}

TEST(UniformGrid, ListsPrimitivesInOrder) {
    World world(random_soup(3000, 0.05, 32));
    const UniformGrid grid(world.input());
    for (std::size_t cell = 0; cell + 1 < grid.offsets().size(); ++cell) {
        for (std::uint32_t i = grid.offsets()[cell] + 1; i < grid.offsets()[cell + 1]; ++i) {
            ASSERT_LT(grid.references()[i - 1], grid.references()[i]);
        }
    }
}

TEST(UniformGrid, LimitsItsReferences) {
    // All of them reach through the whole scene.
    World world(random_soup(20000, 2.0, 33));
    const UniformGrid grid(world.input());
    EXPECT_LE(grid.statistics().references, 24u * 20000u + 65536u);
}

TEST(UniformGrid, CountsReferencesInItsStatistics) {
    World world(cubes(5));
    const UniformGrid grid(world.input());
    const GridStatistics statistics = grid.statistics();
    EXPECT_EQ(statistics.references, grid.references().size());
    EXPECT_EQ(statistics.cells + 1, grid.offsets().size());
    EXPECT_EQ(statistics.resolution, grid.resolution());
}

TEST(UniformGrid, StopsWhenAsked) {
    int calls = 0;
    World world(random_soup(50000, 0.01, 34), 2, [&](double, const char*) { return ++calls == 2; });
    EXPECT_THROW(UniformGrid(world.input()), Error);
}

TEST(UniformGrid, ReportsProgressFromZeroToOne) {
    std::vector<double> fractions;
    World world(random_soup(50000, 0.01, 34), 1, [&](double fraction, const char*) {
        fractions.push_back(fraction);
        return false;
    });
    const UniformGrid grid(world.input());
    ASSERT_GE(fractions.size(), 4u);
    for (std::size_t i = 0; i < fractions.size(); ++i) {
        EXPECT_GE(fractions[i], i == 0 ? 0.0 : fractions[i - 1]);
        EXPECT_LE(fractions[i], 1.0);
    }
}

// ---- the resolution ----

using Resolution = std::array<std::uint32_t, 3>;

TEST(GridResolution, MakesAsManyCubesAsAskedFor) {
    EXPECT_EQ(grid_resolution({1, 1, 1}, 4096, 1.0), (Resolution{16, 16, 16}));
    EXPECT_EQ(grid_resolution({2, 2, 2}, 1000, 8.0), (Resolution{20, 20, 20}));
    EXPECT_EQ(grid_resolution({8, 4, 2}, 64, 1.0), (Resolution{8, 4, 2}));
    EXPECT_EQ(grid_resolution({2, 8, 4}, 64, 1.0), (Resolution{2, 8, 4}));
    EXPECT_EQ(grid_resolution({1e30, 1e30, 1e30}, 27, 1.0), (Resolution{3, 3, 3}));
    EXPECT_EQ(grid_resolution({1e-200, 1e-200, 1e-200}, 27, 1.0), (Resolution{3, 3, 3}));
}

// Havran and Sixta's scenes, with the boxes that the generators' files have. Their boxes must have been a little
// different (their numbers of cells exceed density * primitives at times), so that theirs are met within one cell in
// ten.
TEST(GridResolution, IsThatOfHavranAndSixta) {
    const struct {
        Vec3 size;
        double primitives;
        double density;
        Resolution published;
    } scenes[] = {
        {{24, 24, 1.3306}, 7382, 1, {46, 46, 3}},
        {{24, 24, 1.3306}, 7382, 10, {103, 103, 7}},
        {{4, 4, 1}, 9345, 1, {32, 33, 9}},
        {{4, 4, 1}, 9345, 10, {71, 71, 18}},
        {{2.1596, 2.1596, 2.0812}, 8196, 1, {20, 20, 20}},
        {{8, 8, 3.15}, 9264, 1, {28, 29, 11}},
        {{2, 2, 2}, 4096, 1, {16, 16, 16}},
    };
    for (const auto& scene : scenes) {
        const Resolution ours = grid_resolution(scene.size, scene.primitives, scene.density);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(ours[axis], scene.published[axis], 1.0 + 0.1 * scene.published[axis]);
        }
        EXPECT_LE(static_cast<double>(ours[0]) * ours[1] * ours[2], scene.primitives * scene.density);
    }
}

TEST(GridResolution, GivesThinAxesOneCellAndTheOthersAll) {
    EXPECT_EQ(grid_resolution({1, 1, 0}, 100, 1.0), (Resolution{10, 10, 1}));
    EXPECT_EQ(grid_resolution({0, 3, 3}, 100, 1.0), (Resolution{1, 10, 10}));
    EXPECT_EQ(grid_resolution({4, 0, 1}, 100, 1.0), (Resolution{20, 1, 5}));
    EXPECT_EQ(grid_resolution({1, 1, 1e-9}, 100, 1.0), (Resolution{10, 10, 1}));
    EXPECT_EQ(grid_resolution({1, 1e-9, 1e-9}, 100, 1.0), (Resolution{100, 1, 1}));
    EXPECT_EQ(grid_resolution({1, 1e-300, 0}, 100, 1.0), (Resolution{100, 1, 1}));
    EXPECT_EQ(grid_resolution({0, 0, 0}, 100, 1.0), (Resolution{1, 1, 1}));
    EXPECT_EQ(grid_resolution({1, 1, 1}, 1, 0.5), (Resolution{1, 1, 1}));
}

TEST(GridResolution, IsLimited) {
    const Resolution resolution = grid_resolution({1, 1, 1}, 4e9, 100.0);
    EXPECT_LE(static_cast<double>(resolution[0]) * resolution[1] * resolution[2], 0x1p30);
}

} // namespace
} // namespace raywise
