// The grid of two levels: a coarse grid, of which each cell that holds too much has a grid of its own (Jevans and Wyvill 1989, "Adaptive
// Voxel Subdivision for Ray Tracing"; all cells of all those in one array, as Kalojanov, Billeter and Slusallek 2011, "Two-Level Grids for
// Ray Tracing on GPUs", have them). For the teapot in a stadium: where all detail is in a few cells of the coarse grid.
//
// A cell's grid lies over what of the cell its primitives reach. Few that are large against the others stay out of it and are listed in the
// cell itself: the ground that a small thing stands on must not decide about the cells of the thing.
//
// Why no hit is lost. At one moment of the coarse walk the ray is in a cell that holds the hit's point P but for less than
// half of overlap_slack cells, and the primitive is listed there (cell_walk.h). If it is one of the cell's own, it is tested. Else it is
// in the cell's grid, whose bounds hold P: they are those of its primitives, of which P is a point, within the cell moved apart by
// overlap_slack. So the walk through that grid, along the same ray, comes to the cell of P, as cell_walk.h shows for any lattice, as long
// as the lattice's cells are so wide that half of overlap_slack of them is above 8 * 2^-53 * R, which
// walkable_resolution (grid_choice.h) sees to for the scene's R.
#pragma once

#include "accel/grid/cell_lattice.h"
#include "accel/grid/grid_accel.h"
#include "accel/grid/grid_lists.h"
#include "accel/ray_kernels.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace raywise {

struct TwoLevelOptions {
    double coarse_density = 0.25;        // cells per primitive
    double density = 1.0;                // of the cells' own grids, per reference
    std::uint32_t most_in_a_cell = 32;   // more references have a grid of their own
    std::uint32_t most_large_apart = 64; // more primitives that are large against the cell's others are no exception
};

// A grid within a coarse cell.
struct InnerGrid {
    CellLattice lattice;
    std::uint32_t first_cell = 0; // its numbers among those of all inner grids; a multiple of cells_per_brick
};

struct TwoLevels {
    static constexpr std::uint32_t no_grid = std::numeric_limits<std::uint32_t>::max();

    CellLattice coarse;
    GridLists own;                     // of each coarse cell; occupied tells the cells with a grid as well
    PageArray<std::uint32_t> inner_of; // the grid of each coarse cell, or no_grid
    PageVector<InnerGrid> inner;
    GridLists lists; // of the cells of all inner grids

    std::size_t bytes() const {
        return own.bytes() + inner_of.bytes() + inner.capacity() * sizeof(InnerGrid) + lists.bytes();
    }
};

struct TracedLevels {
    const Primitives& primitives;
    const TwoLevels& levels;
};

RW_DECLARE_RAY_KERNELS(TracedLevels);

class TwoLevelGrid final : public GridAccel<TwoLevelGrid> {
public:
    explicit TwoLevelGrid(const BuildInput& input) : TwoLevelGrid(input, TwoLevelOptions{}) {}
    TwoLevelGrid(const BuildInput& input, const TwoLevelOptions& options);

    std::size_t bytes() const override { return sizeof *this + levels_.bytes(); }
    const TwoLevels& levels() const { return levels_; }

private:
    friend class GridAccel<TwoLevelGrid>;
    TracedLevels traced() const { return {primitives_, levels_}; }

    const Primitives& primitives_;
    TwoLevels levels_;
};

} // namespace raywise
