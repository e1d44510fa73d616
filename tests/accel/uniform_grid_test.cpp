#include "accel/grid/uniform_grid.h"

#include "accel/grid_kd_testing.h"
#include "geometry/triangle_box_overlap.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

namespace raywise {
namespace {

using namespace grid_kd_testing;

void expect_same_lists(const UniformGrid& a, const UniformGrid& b) {
    ASSERT_EQ(a.lattice().resolution, b.lattice().resolution);
    ASSERT_EQ(a.lists().references.size(), b.lists().references.size());
    EXPECT_TRUE(std::equal(a.lists().references.begin(), a.lists().references.end(), b.lists().references.begin()));
    for (std::uint64_t cell = 0; a.lattice().number_count > 0 && cell <= a.lattice().number_count; ++cell) {
        ASSERT_EQ(a.lists().offset(cell), b.lists().offset(cell));
    }
}

class UniformGridOn : public ::testing::TestWithParam<NamedSoup> {};

TEST_P(UniformGridOn, AnswersAsTheLinearScan) {
    World world(GetParam().make());
    const UniformGrid grid(world.input());
    expect_scan_answers(world, grid, 101);
}

TEST_P(UniformGridOn, AnswersAsTheLinearScanAtOtherDensities) {
    World world(GetParam().make());
    for (const double density : {0.1, 50.0}) {
        GridOptions options;
        options.density = density;
        const UniformGrid grid(world.input(), options);
        expect_scan_answers(world, grid, 102);
    }
}

TEST_P(UniformGridOn, AnswersAsTheLinearScanWithOtherSwitches) {
    World world(GetParam().make());
    for (const OverlapTest overlap_test : {OverlapTest::none, OverlapTest::all}) {
        GridOptions options;
        options.overlap_test = overlap_test;
        options.mailboxes = overlap_test == OverlapTest::all;
        options.gather = false;
        const UniformGrid grid(world.input(), options);
        expect_scan_answers(world, grid, 103);
    }
}

TEST_P(UniformGridOn, IsTheSameWithWideOffsets) {
    World world(GetParam().make());
    GridOptions options;
    options.gather = false;
    const UniformGrid narrow(world.input(), options);
    options.max_narrow_references = 0;
    const UniformGrid wide(world.input(), options);
    EXPECT_EQ(wide.lists().is_wide(), world.primitives().hittable_count() > 0);
    EXPECT_FALSE(narrow.lists().is_wide());
    options.gather = true;
    if (world.soup().size() < 200) expect_scan_answers(world, UniformGrid(world.input(), options), 105);
    expect_same_lists(narrow, wide);
    if (world.soup().size() < 1000) expect_scan_answers(world, wide, 104);
}

INSTANTIATE_TEST_SUITE_P(Scenes, UniformGridOn, ::testing::ValuesIn(hard_scenes()),
                         [](const auto& scene) { return scene.param.name; });

TEST(UniformGrid, HasNoCellsWithoutPrimitives) {
    World world({});
    const UniformGrid grid(world.input());
    EXPECT_EQ(grid.statistics().cells, 0u);
    EXPECT_EQ(grid.lattice().resolution, (std::array<std::uint32_t, 3>{0, 0, 0}));
}

TEST(UniformGrid, AnswersAsTheLinearScanForNextToAxisParallelRays) { expect_scan_answers_next_to_axes<UniformGrid>(); }

TEST(UniformGrid, IsTheSameForAnyNumberOfThreads) {
    const Soup soup = random_soup(60000, 0.01, 31);
    World one(soup, 1);
    World two(soup, 2);
    GridOptions options;
    options.gather = false;
    const UniformGrid a(one.input(), options);
    const UniformGrid b(two.input(), options);
    EXPECT_EQ(a.bytes(), b.bytes());
    expect_same_lists(a, b);
    options.gather = true;
    const UniformGrid c(one.input(), options);
    const UniformGrid d(two.input(), options);
    ASSERT_EQ(c.lists().blocks.size(), d.lists().blocks.size());
    EXPECT_EQ(std::memcmp(c.lists().blocks.data(), d.lists().blocks.data(), c.lists().blocks.size()), 0);
}

TEST(UniformGrid, ListsPrimitivesInTheCellsThatTheyOverlapAndOnce) {
    World world(random_soup(3000, 0.05, 32));
    for (const OverlapTest overlap_test : {OverlapTest::none, OverlapTest::large, OverlapTest::all}) {
        GridOptions options;
        options.overlap_test = overlap_test;
        options.gather = false;
        options.density = 4.0;
        const UniformGrid grid(world.input(), options);
        const CellLattice& lattice = grid.lattice();
        std::set<std::pair<std::uint32_t, std::uint32_t>> listed; // cell, primitive
        for (std::uint32_t cell = 0; cell < lattice.number_count; ++cell) {
            for (std::uint64_t i = grid.lists().offset(cell); i < grid.lists().offset(cell + 1); ++i) {
                EXPECT_TRUE(listed.insert({cell, grid.lists().references[i]}).second);
            }
            const bool occupied = (grid.lists().occupied[cell / 64] >> (cell % 64) & 1u) != 0;
            EXPECT_EQ(occupied, grid.lists().count(cell) > 0);
        }
        std::size_t in_boxes = 0;
        for (std::uint32_t i = 0; i < world.soup().size(); ++i) {
            Corners corners = world.soup()[i];
            for (Vec3& p : corners) p = (p - lattice.bounds.lower) * lattice.cells_per_unit;
            const CellRange range = bounding_cells(corners, lattice.resolution);
            in_boxes += static_cast<std::size_t>(range.extent(0) * range.extent(1) * range.extent(2));
            for_each_overlapped_cell(corners, range, [&](std::int32_t x, std::int32_t y, std::int32_t z) {
                const std::uint32_t cell = lattice.number(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                                          static_cast<std::uint32_t>(z));
                EXPECT_EQ(listed.count({cell, i}), 1u);
            });
        }
        EXPECT_GE(in_boxes, listed.size());
        EXPECT_EQ(overlap_test == OverlapTest::none, in_boxes == listed.size());
    }
}

TEST(UniformGrid, LimitsItsReferences) {
    // All of them reach through the whole scene.
    World world(random_soup(20000, 2.0, 33));
    const UniformGrid grid(world.input());
    EXPECT_LE(grid.statistics().references, 24u * 20000u + 65536u);
}

TEST_P(UniformGridOn, AnswersAsTheLinearScanAtForcedResolutions) {
    World world(GetParam().make());
    if (world.primitives().hittable_count() == 0 || world.soup().size() > 200) return;
    for (const std::array<std::uint32_t, 3>& resolution :
         {std::array<std::uint32_t, 3>{1, 1, 1}, {0, 0, 7}, {300, 2, 300}}) {
        GridOptions options;
        options.resolution = resolution;
        const UniformGrid grid(world.input(), options);
        expect_scan_answers(world, grid, 108);
    }
}

TEST(UniformGrid, AnswersAsTheLinearScanWithAsManyCellsAsThereCanBe) {
    World world(random_soup(40, 1e-5, 41));
    constexpr std::uint32_t largest = std::numeric_limits<std::uint32_t>::max();
    GridOptions options;
    options.resolution = {1, largest, 1};
    const UniformGrid grid(world.input(), options);
    EXPECT_GT(grid.lattice().resolution[1], 1u << 20);
    EXPECT_LE(grid.lattice().cell_count(), std::uint64_t{1} << 24);
    expect_scan_answers(world, grid, 109);
}

// A ray from afar is moved next to the scene and rounded there: by more than the slack of the lists, were the cells as narrow as wanted.
TEST(UniformGrid, MakesNoCellNarrowerThanFarRaysAreRounded) {
    for (const double far : {1e9, 1e12, 1e15}) {
        World world(moved(random_soup(200, 0.02, 42), 0x1p-30 * far, Vec3(far, 0.0, -far)));
        GridOptions options;
        options.resolution = {40, 200, 40};
        const UniformGrid grid(world.input(), options);
        const CellLattice& lattice = grid.lattice();
        EXPECT_TRUE(lattice.resolution[0] == 1 || lattice.width.x >= 0x1p-34 * far) << lattice.width.x;
        EXPECT_LT(lattice.resolution[0], 40u);
        EXPECT_EQ(lattice.resolution[1], 200u);
        expect_scan_answers(world, grid, 110);
    }
}

// Few rays: half a cell per primitive; many: a quarter, and the corners in the cells; a memory limit takes the corners away, then cells.
TEST(UniformGrid, GoesByTheRaysThatAreExpectedAndByTheMemoryLimit) {
    World world(random_soup(20000, 0.02, 37));
    BuildInput input = world.input();
    input.rays = 100;
    const UniformGrid few(input);
    EXPECT_FALSE(few.lists().has_blocks());
    EXPECT_NEAR(static_cast<double>(few.lattice().cell_count()), 10000.0, 1000.0);
    input.rays = 1000000;
    const UniformGrid many(input);
    EXPECT_TRUE(many.lists().has_blocks());
    EXPECT_TRUE(many.lists().references.empty());
    EXPECT_NEAR(static_cast<double>(many.lattice().cell_count()), 5000.0, 500.0);
    expect_scan_answers(world, many, 106);

    input.memory_limit = many.bytes() / 2;
    const UniformGrid lists(input);
    EXPECT_FALSE(lists.lists().has_blocks());
    EXPECT_LE(lists.bytes(), input.memory_limit);
    EXPECT_EQ(lists.lattice().resolution, few.lattice().resolution);

    input.memory_limit = lists.bytes() * 3 / 4;
    const UniformGrid coarse(input);
    EXPECT_LE(coarse.bytes(), input.memory_limit);
    EXPECT_LT(coarse.lattice().cell_count(), few.lattice().cell_count());
    EXPECT_GT(coarse.lattice().cell_count(), 1u);
    expect_scan_answers(world, coarse, 107);

    input.memory_limit = 1; // less than anything takes: as little as there is
    EXPECT_EQ(UniformGrid(input).lattice().cell_count(), 1u);
}

// Triangles of several meshes, of float32 and float64: corners are gathered in float64, and one by one where a block has several meshes.
TEST(UniformGrid, GathersCornersOfSeveralMeshes) {
    const Soup soup = rounded_to_float(random_soup(300, 0.1, 38));
    std::vector<float> narrow;
    for (const Corners& c : soup)
        for (const Vec3& p : c)
            for (int axis = 0; axis < 3; ++axis) narrow.push_back(static_cast<float>(p[axis]));
    const auto mesh = [](const void* data, std::size_t count, Scalar scalar) {
        TriangleArrays arrays;
        const auto size = static_cast<std::ptrdiff_t>(size_of(scalar));
        arrays.vertices = {static_cast<const std::byte*>(data), 3 * size, size, scalar};
        arrays.vertex_count = 3 * count;
        arrays.triangle_count = count;
        return std::make_shared<const TriangleMesh>(arrays, false, false);
    };
    const Primitives mixed({mesh(narrow.data(), 300, Scalar::float32), mesh(soup.data(), 300, Scalar::float64)});
    const Parallel parallel(1);
    Progress progress;
    const BuildInput input{mixed, {}, {}, parallel, progress};
    GridOptions options;
    options.gather = true;
    const UniformGrid gathered(input, options);
    options.gather = false;
    const UniformGrid listed(input, options);
    EXPECT_TRUE(gathered.lists().blocks_are_float64);
    const World world(soup);
    for (const Ray& ray : hard_rays(world, 3, 39)) {
        EXPECT_TRUE(bits_equal(listed.closest(ray, {}), gathered.closest(ray, {}))) << describe(ray);
        const PrimitiveHit alone = oracle::PlainScan(input).closest(ray, {});
        EXPECT_TRUE(bits_equal(alone, gathered.closest(ray, {}))) << describe(ray);
    }
}

TEST(UniformGrid, CountsReferencesInItsStatistics) {
    World world(cubes(5));
    const UniformGrid grid(world.input());
    const GridStatistics statistics = grid.statistics();
    EXPECT_EQ(statistics.references, grid.lists().offset(grid.lattice().number_count));
    EXPECT_EQ(statistics.cells, grid.lattice().cell_count());
    EXPECT_EQ(statistics.resolution, grid.lattice().resolution);
}

TEST(UniformGrid, BearsAMillionEqualTriangles) { expect_bears_a_million_equal_triangles<UniformGrid>(); }

TEST(UniformGrid, StopsWhenAsked) { expect_stops_when_asked<UniformGrid>(2); }

TEST(UniformGrid, ReportsProgressFromZeroToOne) { expect_progress_from_zero_to_one<UniformGrid>(); }

// ---- the lattice ----

TEST(CellLattice, NumbersCellsOnceEachAndBricksTogether) {
    for (const std::array<std::uint32_t, 3>& resolution : {std::array<std::uint32_t, 3>{1, 1, 1},
                                                           {4, 4, 4},
                                                           {5, 9, 13},
                                                           {1, 20, 20},
                                                           {17, 1, 3},
                                                           {2, 2, 200},
                                                           {130, 1, 1}}) {
        const CellLattice lattice({Vec3(0.0), Vec3(1.0)}, resolution);
        EXPECT_EQ(lattice.number_count % cells_per_brick, 0u);
        std::set<std::uint32_t> numbers;
        for (std::uint32_t z = 0; z < resolution[2]; ++z) {
            for (std::uint32_t y = 0; y < resolution[1]; ++y) {
                for (std::uint32_t x = 0; x < resolution[0]; ++x) numbers.insert(lattice.number(x, y, z));
            }
        }
        EXPECT_EQ(numbers.size(), lattice.cell_count());
        EXPECT_LT(*numbers.rbegin(), lattice.number_count);
        EXPECT_LE(lattice.number_count, std::max<std::uint64_t>(64, 4 * lattice.cell_count()));
        const std::array<std::uint32_t, 3>& last = resolution;
        EXPECT_EQ(lattice.number(0, 0, 0), 0u);
        EXPECT_EQ(lattice.number(std::min(1u, last[0] - 1), std::min(1u, last[1] - 1), std::min(1u, last[2] - 1)) / 64,
                  0u);
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
