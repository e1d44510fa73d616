#include "accel/grid/grid_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace raywise {
namespace {

TEST(GridStatistics, FollowsTheEquations) {
    // Counts 0, 0, 1, 3: mean 1, distances -1, -1, 0, 2; squares sum to 6, cubes to 6, fourth powers to 18.
    const GridStatistics s = grid_statistics({2, 2, 1}, {0, 0, 1, 3});
    EXPECT_EQ(s.resolution, (std::array<std::uint32_t, 3>{2, 2, 1}));
    EXPECT_EQ(s.cells, 4u);
    EXPECT_EQ(s.empty_cells, 2u);
    EXPECT_EQ(s.references, 4u);
    EXPECT_EQ(s.max_references, 3u);
    EXPECT_DOUBLE_EQ(s.sparseness, 0.5);
    EXPECT_DOUBLE_EQ(s.mean, 1.0);
    EXPECT_DOUBLE_EQ(s.variance, 2.0);
    EXPECT_DOUBLE_EQ(s.standard_deviation, std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(s.skewness, 6.0 / 4.0 / (2.0 * std::sqrt(2.0)));
    EXPECT_DOUBLE_EQ(s.kurtosis, 18.0 / 4.0 / 4.0 - 3.0);
}

TEST(GridStatistics, IsSymmetricWhereTheCountsAre) {
    const GridStatistics s = grid_statistics({5, 1, 1}, {1, 2, 3, 4, 5});
    EXPECT_DOUBLE_EQ(s.sparseness, 0.0);
    EXPECT_DOUBLE_EQ(s.mean, 3.0);
    EXPECT_DOUBLE_EQ(s.variance, 2.5);
    EXPECT_DOUBLE_EQ(s.skewness, 0.0);
    EXPECT_DOUBLE_EQ(s.kurtosis, 34.0 / 5.0 / 6.25 - 3.0);
}

TEST(GridStatistics, HasNoShapeWithoutSpread) {
    for (const auto& counts : {std::vector<std::uint32_t>{7}, {4, 4, 4}, {0, 0}}) {
        const GridStatistics s = grid_statistics({static_cast<std::uint32_t>(counts.size()), 1, 1}, counts);
        EXPECT_EQ(s.mean, counts[0]);
        EXPECT_EQ(s.variance, 0.0);
        EXPECT_EQ(s.standard_deviation, 0.0);
        EXPECT_EQ(s.skewness, 0.0);
        EXPECT_EQ(s.kurtosis, 0.0);
    }
}

TEST(GridStatistics, IsZeroWithoutCells) {
    const GridStatistics s = grid_statistics({0, 0, 0}, {});
    EXPECT_EQ(s.cells, 0u);
    EXPECT_EQ(s.sparseness, 0.0);
    EXPECT_EQ(s.mean, 0.0);
}

// Large numbers that differ little: sums of plain squares would lose the difference.
TEST(GridStatistics, IsStable) {
    std::vector<std::uint32_t> counts;
    for (std::uint32_t i = 0; i < 42; ++i) counts.push_back(100'000'000 + i % 2);
    const GridStatistics s = grid_statistics({42, 1, 1}, counts);
    EXPECT_DOUBLE_EQ(s.mean, 100'000'000.5);
    EXPECT_DOUBLE_EQ(s.variance, 42.0 / 41.0 / 4.0);
    EXPECT_NEAR(s.skewness, 0.0, 1e-12);
    EXPECT_NEAR(s.kurtosis, (41.0 / 42.0) * (41.0 / 42.0) - 3.0, 1e-12);
}

} // namespace
} // namespace raywise
