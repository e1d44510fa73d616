// What builders of grids can be told; the default is what the library uses, the rest is for tests and studies.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace raywise {

// Which triangles are held against each cell of their bounding box's; the others are listed in all of them.
enum class OverlapTest {
    none,
    large, // those that reach over more than two cells along some axis
    all
};

struct GridOptions {
    std::optional<double> density; // cells per primitive; empty: by the rays that are expected
    // Cells along each axis instead: one where the bounds are flat, at most CellLattice::max_cells_along_axis, and max_cells in all.
    std::optional<std::array<std::uint32_t, 3>> resolution;
    OverlapTest overlap_test = OverlapTest::large;
    bool mailboxes = true; // where the corners are not gathered
    // Whether cells have the corners of their triangles beside each other; empty: by the rays that are expected.
    std::optional<bool> gather;
    // More references than that are counted in 64 bits.
    std::uint64_t max_narrow_references = 0xFFFFFFF0u;
};

} // namespace raywise
