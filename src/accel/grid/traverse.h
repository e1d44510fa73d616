// Rays through a grid.
#pragma once

#include "accel/accel.h"
#include "accel/grid/cell_lattice.h"
#include "accel/grid/grid_lists.h"
#include "accel/ray_kernels.h"

namespace raywise {

struct TracedGrid {
    const Primitives& primitives;
    const CellLattice& lattice;
    const GridLists& lists;
    bool mailboxes;
};

RW_DECLARE_RAY_KERNELS(TracedGrid);

} // namespace raywise
