// The uniform grid: equal cells, each with the list of primitives that overlap it, and a walk from cell to cell along
// the ray (GridAccel in Chuang's lecture "Acceleration"). Why the walk loses no hit: cell_walk.h.
#pragma once

#include "accel/grid/cell_lattice.h"
#include "accel/grid/grid_accel.h"
#include "accel/grid/grid_lists.h"
#include "accel/grid/grid_options.h"
#include "accel/grid/grid_statistics.h"
#include "accel/grid/traverse.h"

#include <cstddef>

namespace raywise {

class UniformGrid final : public GridAccel<UniformGrid> {
public:
    explicit UniformGrid(const BuildInput& input) : UniformGrid(input, GridOptions{}) {}
    UniformGrid(const BuildInput& input, const GridOptions& options);

    std::size_t bytes() const override { return sizeof *this + lists_.bytes(); }

    // Of zero cells without hittable primitives.
    const CellLattice& lattice() const { return lattice_; }
    const GridLists& lists() const { return lists_; }
    // Looks at every cell once or twice.
    GridStatistics statistics() const;

private:
    friend class GridAccel<UniformGrid>;
    TracedGrid traced() const { return {primitives_, lattice_, lists_, mailboxes_}; }

    const Primitives& primitives_;
    CellLattice lattice_;
    GridLists lists_;
    bool mailboxes_;
};

} // namespace raywise
