// The primitives of each cell, one list behind the other.
#pragma once

#include "accel/accel.h"
#include "accel/grid/cell_lattice.h"
#include "accel/grid/grid_options.h"
#include "accel/grid/progress_part.h"
#include "base/page_array.h"
#include "geometry/triangle_block.h"

#include <cstddef>
#include <cstdint>

namespace raywise {

struct GridLists {
    // What the offsets count: the primitives, or blocks of them (geometry/triangle_block.h), each cell's first block at its offset.
    PageArray<std::uint32_t> references;
    PageArray<std::byte> blocks;
    bool blocks_are_float64 = false;
    // Where each cell's references begin, and the end of all; in one of the two, which is as wide as their number asks for.
    PageArray<std::uint32_t> narrow_offsets;
    PageArray<std::uint64_t> wide_offsets;
    // A bit for each cell, a word for each brick: most cells are empty, and their offsets would take 32 times the memory that a ray
    // comes to.
    PageArray<std::uint64_t> occupied;

    bool has_blocks() const { return !blocks.empty(); }
    bool is_wide() const { return !wide_offsets.empty(); }
    std::uint64_t offset(std::uint64_t cell) const { return is_wide() ? wide_offsets[cell] : narrow_offsets[cell]; }
    std::uint32_t count(std::uint64_t cell) const {
        return static_cast<std::uint32_t>(offset(cell + 1) - offset(cell));
    }
    std::size_t bytes() const {
        return references.bytes() + blocks.bytes() + narrow_offsets.bytes() + wide_offsets.bytes() + occupied.bytes();
    }
    static std::size_t bytes_for(std::uint64_t cells, std::uint64_t references, bool wide) {
        return references * sizeof(std::uint32_t) +
               (cells + 1) * (wide ? sizeof(std::uint64_t) : sizeof(std::uint32_t)) + cells / 8;
    }
};

// Lists of the hittable primitives, of which there are some, over their bounds, with options.density cells per primitive: fewer where there
// would be too many references (grid_choice.h), or where the lists would take more than input.memory_limit and can do with less. The
// same for every number of threads. Returns the lattice.
CellLattice build_limited_lists(const BuildInput& input, const GridOptions& options, const ProgressPart& progress,
                                GridLists& lists);

} // namespace raywise
