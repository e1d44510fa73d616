// Which cells of a grid of unit cubes a triangle overlaps.
//
// Everything is in grid coordinates: cell (i, j, k) is the cube from (i, j, k) to (i + 1, j + 1, k + 1). The answer
// is exact up to `overlap_slack`: every cell that the triangle comes nearer to than half of it is named, and none
// that it stays further away from than one and a half. The slack is what lets a traversal with rounded distances find
// every primitive (uniform_grid.h); it is larger than any rounding here by a factor of more than 2^10 while a grid
// has fewer than 2^24 cells along an axis.
#pragma once

#include "base/box.h"
#include "geometry/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace raywise {

constexpr double overlap_slack = 0x1p-16; // cells

// Cells from lower to upper, both included.
struct CellRange {
    std::array<std::int32_t, 3> lower;
    std::array<std::int32_t, 3> upper;

    std::int64_t extent(int axis) const {
        const auto a = static_cast<std::size_t>(axis);
        return std::int64_t{upper[a]} - lower[a] + 1;
    }
};

// The cells that the triangle's bounding box overlaps, within a grid of that resolution.
CellRange bounding_cells(const Corners& triangle, const std::array<std::uint32_t, 3>& resolution);

// The separating axis test of Akenine-Moller 2001, "Fast 3D Triangle-Box Overlap Testing", for one triangle against
// many cells: a projection of the triangle and of the unit cube onto an axis does not change from cell to cell, so
// what is left for each cell is a dot product between two bounds (as in Schwarz and Seidel 2010, "Fast Parallel
// Surface and Solid Voxelization on GPUs"). The box's own axes are left out: ask about cells within bounding_cells
// only.
class TriangleCellTest {
public:
    // base: a cell near the triangle; cells are named by their distance from it. flat_axis: an axis along which the
    // triangle is within one cell, so that overlaps_in_plane() across that axis is all there is to ask; -1 when there
    // is none.
    TriangleCellTest(const Corners& triangle, const std::array<std::int32_t, 3>& base, int flat_axis = -1);

    // x and y: the cell's place along the two axes that follow the normal's.
    bool overlaps_in_plane(int normal_axis, double x, double y) const {
        bool inside = true;
        for (const Slab2& slab : edges_[static_cast<std::size_t>(normal_axis)]) {
            const double position = slab.x * x + slab.y * y;
            inside = inside & (position >= slab.lower) & (position <= slab.upper);
        }
        return inside;
    }

    bool overlaps(const std::array<double, 3>& cell) const {
        const double position = normal_.x * cell[0] + normal_.y * cell[1] + normal_.z * cell[2];
        if (!(position >= plane_lower_ && position <= plane_upper_)) return false;
        return overlaps_in_plane(0, cell[1], cell[2]) && overlaps_in_plane(1, cell[2], cell[0]) &&
               overlaps_in_plane(2, cell[0], cell[1]);
    }

private:
    // Cells whose x * i + y * j lies between the bounds are not separated along (x, y).
    struct Slab2 {
        double x;
        double y;
        double lower;
        double upper;
    };

    // For each axis the three edges' normals in the plane across it.
    std::array<std::array<Slab2, 3>, 3> edges_;
    Vec3 normal_;
    double plane_lower_;
    double plane_upper_;
};

struct SideBoxes {
    Box below;
    Box above;
};

// A convex polygon, the part of a triangle within some slabs.
class ClippedTriangle {
public:
    explicit ClippedTriangle(const Corners& triangle) : count_(3) {
        for (std::size_t i = 0; i < 3; ++i) points_[i] = triangle[i];
    }

    // Keeps what lies between lower and upper along the axis (Sutherland and Hodgman 1974). A new corner lies on its
    // edge but for rounding of a few units in the last place of the edge's ends, however flat the angle between edge
    // and plane.
    void clip(int axis, double lower, double upper) {
        cut(axis, lower, 1.0);
        cut(axis, upper, -1.0);
    }

    bool empty() const { return count_ == 0; }
    // Lowest and highest coordinate along an axis; not of an empty polygon.
    std::array<double, 2> extent(int axis) const;
    // The boxes of what lies up to `below_to` along the axis, and of what lies from `above_from` on.
    SideBoxes boxes_of_sides(int axis, double below_to, double above_from) const;

private:
    // Where the line from a to b, on different sides, is at `position`.
    static Vec3 crossing(const Vec3& a, const Vec3& b, int axis, double position);

    // Keeps the points with sign * (point - position) >= 0.
    void cut(int axis, double position, double sign);

    // Each cut adds at most one corner; the kd-tree's builder makes six.
    std::array<Vec3, 9> points_;
    std::size_t count_;
};

// Calls emit(i, j, k) once for each cell of the range that the triangle overlaps; range: bounding_cells of the
// triangle.
template <class Emit>
void for_each_overlapped_cell(const Corners& triangle, const CellRange& range, Emit&& emit);

namespace triangle_box_overlap_detail {

// Above so many cells in the range, slabs and rows of the triangle find its cells in time proportional to the
// number of rows; below, testing each cell is quicker.
constexpr std::int64_t most_cells_to_test = 32;

// Slices the triangle along one axis, the slices along the next; what remains of a row's triangle is convex, so it
// overlaps a run of cells without a gap.
template <class Emit>
void emit_by_rows(const Corners& triangle, const CellRange& range, Emit&& emit) {
    // Runs along the axis the triangle is the most parallel to are the longest.
    const Vec3 normal = glm::abs(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
    const int run = normal.x <= normal.y ? (normal.x <= normal.z ? 0 : 2) : (normal.y <= normal.z ? 1 : 2);
    const int row = (run + 1) % 3;
    const int slab = (run + 2) % 3;
    const auto cells = [&](const ClippedTriangle& part, int axis) {
        const auto a = static_cast<std::size_t>(axis);
        const std::array<double, 2> extent = part.extent(axis);
        return std::array<std::int32_t, 2>{
            static_cast<std::int32_t>(std::max<double>(range.lower[a], std::floor(extent[0] - overlap_slack))),
            static_cast<std::int32_t>(std::min<double>(range.upper[a], std::floor(extent[1] + overlap_slack)))};
    };
    std::array<std::int32_t, 3> cell;
    for (std::int32_t s = range.lower[static_cast<std::size_t>(slab)]; s <= range.upper[static_cast<std::size_t>(slab)];
         ++s) {
        ClippedTriangle slice(triangle);
        slice.clip(slab, s - overlap_slack, s + 1.0 + overlap_slack);
        if (slice.empty()) continue;
        cell[static_cast<std::size_t>(slab)] = s;
        const auto rows = cells(slice, row);
        for (std::int32_t r = rows[0]; r <= rows[1]; ++r) {
            ClippedTriangle strip = slice;
            strip.clip(row, r - overlap_slack, r + 1.0 + overlap_slack);
            if (strip.empty()) continue;
            cell[static_cast<std::size_t>(row)] = r;
            const auto cells_of_run = cells(strip, run);
            for (std::int32_t c = cells_of_run[0]; c <= cells_of_run[1]; ++c) {
                cell[static_cast<std::size_t>(run)] = c;
                emit(cell[0], cell[1], cell[2]);
            }
        }
    }
}

} // namespace triangle_box_overlap_detail

template <class Emit>
void for_each_overlapped_cell(const Corners& triangle, const CellRange& range, Emit&& emit) {
    using namespace triangle_box_overlap_detail;
    const std::int64_t extent[3] = {range.extent(0), range.extent(1), range.extent(2)};
    const auto& lower = range.lower;
    const auto& upper = range.upper;
    const int wide = (extent[0] > 1 ? 1 : 0) + (extent[1] > 1 ? 1 : 0) + (extent[2] > 1 ? 1 : 0);
    if (wide <= 1) {
        // A triangle is connected: within a row of cells it overlaps all from its lowest to its highest.
        for (std::int32_t k = lower[2]; k <= upper[2]; ++k) {
            for (std::int32_t j = lower[1]; j <= upper[1]; ++j) {
                for (std::int32_t i = lower[0]; i <= upper[0]; ++i) emit(i, j, k);
            }
        }
        return;
    }
    if (extent[0] > most_cells_to_test || extent[1] > most_cells_to_test || extent[2] > most_cells_to_test ||
        extent[0] * extent[1] * extent[2] > most_cells_to_test) {
        emit_by_rows(triangle, range, emit);
        return;
    }
    const int flat = extent[0] == 1 ? 0 : extent[1] == 1 ? 1 : extent[2] == 1 ? 2 : -1;
    const TriangleCellTest test(triangle, lower, flat);
    std::array<double, 3> at;
    for (std::int32_t k = lower[2]; k <= upper[2]; ++k) {
        at[2] = k - lower[2];
        for (std::int32_t j = lower[1]; j <= upper[1]; ++j) {
            at[1] = j - lower[1];
            for (std::int32_t i = lower[0]; i <= upper[0]; ++i) {
                at[0] = i - lower[0];
                const bool overlaps = flat < 0
                                          ? test.overlaps(at)
                                          : test.overlaps_in_plane(flat, at[static_cast<std::size_t>((flat + 1) % 3)],
                                                                   at[static_cast<std::size_t>((flat + 2) % 3)]);
                if (overlaps) emit(i, j, k);
            }
        }
    }
}

} // namespace raywise
