// The corners of each cell's triangles beside each other, as leaves of hierarchies have them: a ray comes to them by one step through memory
// instead of three, over the list, the indices and the vertices.
#pragma once

#include "accel/grid/grid_lists.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "geometry/primitives.h"

namespace raywise {

// Whether blocks of so many references stay within input.memory_limit, beside `bytes`. Never where there are more than twelve for each
// primitive: sticks have ten, and primitives that lie in one place would take a kilobyte each.
bool fits_blocks(const BuildInput& input, std::uint64_t bytes, std::uint64_t references);

// Puts blocks in the place of the references.
void write_cell_blocks(const Primitives& primitives, const Parallel& parallel, const ProgressPart& progress,
                       GridLists& lists);

} // namespace raywise
