// Which cells of a lattice one triangle lies in, cell by cell.
#pragma once

#include "accel/grid/cell_pairs.h"
#include "geometry/triangle_box_overlap.h"

namespace raywise {

inline bool is_small(const CellRange& range) {
    return range.extent(0) <= 2 && range.extent(1) <= 2 && range.extent(2) <= 2;
}

// Adds its pairs, or some of them and more than `most`. OverlapTest::large as for many triangles; see cell_pairs.h.
inline void add_one_triangle(const Corners& triangle, const CellLattice& lattice, OverlapTest overlap_test,
                             std::uint32_t first_cell, std::uint32_t primitive, std::size_t most, CellPairs& pairs) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = (triangle[k] - lattice.bounds.lower) * lattice.cells_per_unit;
    const CellRange range = bounding_cells(corners, lattice.resolution);
    const auto add = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
        const CellPairs::Room room = pairs.make_room(1);
        *room.cells = first_cell + lattice.number(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                                  static_cast<std::uint32_t>(z));
        *room.primitives = primitive;
        pairs.add(pairs.size() <= most ? 1 : 0); // beyond that nobody looks at them
    };
    if (overlap_test == OverlapTest::all || (overlap_test == OverlapTest::large && !is_small(range))) {
        for_each_overlapped_cell(corners, range, add);
        return;
    }
    for (std::int32_t z = range.lower[2]; z <= range.upper[2] && pairs.size() <= most; ++z) {
        for (std::int32_t y = range.lower[1]; y <= range.upper[1] && pairs.size() <= most; ++y) {
            for (std::int32_t x = range.lower[0]; x <= range.upper[0]; ++x) add(x, y, z);
        }
    }
}

} // namespace raywise
