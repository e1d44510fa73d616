#include "geometry/triangle_box_overlap.h"

#include "accel/grid_kd_testing.h"

#include <set>

namespace raywise {
namespace {

using namespace grid_kd_testing;
using Cell = std::array<std::int32_t, 3>;
using Cells = std::multiset<Cell>;

Cells by_enumeration(const Corners& triangle, const CellRange& range) {
    Cells cells;
    for_each_overlapped_cell(triangle, range, [&](std::int32_t i, std::int32_t j, std::int32_t k) {
        cells.insert({i, j, k});
    });
    return cells;
}

Cells by_rows(const Corners& triangle, const CellRange& range) {
    Cells cells;
    triangle_box_overlap_detail::emit_by_rows(triangle, range, [&](std::int32_t i, std::int32_t j, std::int32_t k) {
        cells.insert({i, j, k});
    });
    return cells;
}

Cells by_test(const Corners& triangle, const CellRange& range) {
    const TriangleCellTest test(triangle, range.lower);
    Cells cells;
    for (std::int32_t k = range.lower[2]; k <= range.upper[2]; ++k) {
        for (std::int32_t j = range.lower[1]; j <= range.upper[1]; ++j) {
            for (std::int32_t i = range.lower[0]; i <= range.upper[0]; ++i) {
                if (test.overlaps(
                        {double(i - range.lower[0]), double(j - range.lower[1]), double(k - range.lower[2])})) {
                    cells.insert({i, j, k});
                }
            }
        }
    }
    return cells;
}

Corners random_triangle(Dice& dice, double extent, double size) {
    const Vec3 center = dice.in({Vec3(0.0), Vec3(extent)});
    const auto corner = [&] { return glm::clamp(center + size * dice.unit(), Vec3(0.0), Vec3(extent)); };
    return {corner(), corner(), corner()};
}

// Two methods that share nothing but the slack: they may differ only where the triangle just touches a cell, which
// does not happen by chance.
TEST(TriangleBoxOverlap, IsTheSameByTestingAndBySlicing) {
    Dice dice(51);
    for (int i = 0; i < 3000; ++i) {
        const Corners triangle = random_triangle(dice, 20.0, i % 3 == 0 ? 0.5 : i % 3 == 1 ? 3.0 : 20.0);
        const CellRange range = bounding_cells(triangle, {20, 20, 20});
        const Cells expected = by_test(triangle, range);
        EXPECT_EQ(expected, by_rows(triangle, range));
        EXPECT_EQ(expected, by_enumeration(triangle, range));
    }
}

TEST(TriangleBoxOverlap, NamesTheCellOfEveryPoint) {
    Dice dice(52);
    for (int i = 0; i < 500; ++i) {
        Corners triangle = random_triangle(dice, 30.0, 10.0);
        if (i % 5 == 0) triangle[2] = 0.5 * triangle[0] + 0.5 * triangle[1] + Vec3(1e-13); // a sliver
        if (i % 7 == 0) {
            for (Vec3& p : triangle) p = glm::round(p); // on the planes between cells
        }
        const Cells cells = by_enumeration(triangle, bounding_cells(triangle, {30, 30, 30}));
        for (const Cell& cell : cells) EXPECT_EQ(cells.count(cell), 1u);
        for (int j = 0; j < 100; ++j) {
            double u = dice.between(0.0, 1.0);
            double v = dice.between(0.0, 1.0);
            if (u + v > 1.0) {
                u = 1.0 - u;
                v = 1.0 - v;
            }
            const Vec3 p = triangle[0] + u * (triangle[1] - triangle[0]) + v * (triangle[2] - triangle[0]);
            Cell cell;
            for (int axis = 0; axis < 3; ++axis) {
                cell[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(std::clamp(p[axis], 0.0, 29.0));
            }
            EXPECT_EQ(cells.count(cell), 1u);
        }
    }
}

TEST(TriangleBoxOverlap, LeavesOutWhatTheBoundingBoxOnlySeemsToMeet) {
    const Corners diagonal = {Vec3(0.1, 0.1, 0.5), Vec3(9.9, 9.8, 0.5), Vec3(9.9, 9.9, 0.5)};
    const Cells cells = by_enumeration(diagonal, bounding_cells(diagonal, {10, 10, 1}));
    EXPECT_LE(cells.size(), 28u);
    EXPECT_GE(cells.size(), 10u);
    EXPECT_EQ(cells.count({9, 0, 0}), 0u);
}

TEST(TriangleBoxOverlap, NamesBothCellsAtATouchedPlane) {
    const Corners wall = {Vec3(2.0, 0.2, 0.2), Vec3(2.0, 0.8, 0.2), Vec3(2.0, 0.2, 0.8)};
    EXPECT_EQ(by_enumeration(wall, bounding_cells(wall, {4, 1, 1})), (Cells{{1, 0, 0}, {2, 0, 0}}));
}

TEST(ClippedTriangle, KeepsWhatIsBetweenThePlanes) {
    ClippedTriangle part({Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)});
    part.clip(0, 1.0, 2.0);
    ASSERT_FALSE(part.empty());
    EXPECT_EQ(part.extent(0), (std::array<double, 2>{1.0, 2.0}));
    EXPECT_EQ(part.extent(1), (std::array<double, 2>{0.0, 3.0}));
    const SideBoxes boxes = part.boxes_of_sides(1, 1.0, 2.5);
    EXPECT_EQ(boxes.below.upper, Vec3(2.0, 1.0, 0.0));
    EXPECT_EQ(boxes.above.lower, Vec3(1.0, 2.5, 0.0));
    EXPECT_EQ(boxes.above.upper, Vec3(1.5, 3.0, 0.0));
    part.clip(2, 1.0, 2.0);
    EXPECT_TRUE(part.empty());
}

} // namespace
} // namespace raywise
