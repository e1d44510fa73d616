// Rays through a grid.
#pragma once

#include "accel/accel.h"
#include "accel/collectors.h"
#include "accel/grid/cell_lattice.h"
#include "accel/grid/grid_lists.h"

namespace raywise {

struct TracedGrid {
    const Primitives& primitives;
    const CellLattice& lattice;
    const GridLists& lists;
    bool mailboxes;
};

// As those of Accel.
PrimitiveHit grid_closest(const TracedGrid& grid, const Ray& ray, const Query& query);
PrimitiveHit grid_closest(const TracedGrid& grid, const RayF& ray, const Query& query);
bool grid_any(const TracedGrid& grid, const Ray& ray, const Query& query);
bool grid_any(const TracedGrid& grid, const RayF& ray, const Query& query);
void grid_all(const TracedGrid& grid, const Ray& ray, AllCollector& collector);

} // namespace raywise
