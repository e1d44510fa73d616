#include "accel/grid/uniform_grid.h"

#include "accel/grid/cell_blocks.h"
#include "accel/grid/grid_choice.h"

#include <vector>

namespace raywise {

UniformGrid::UniformGrid(const BuildInput& input, const GridOptions& options)
    : primitives_(input.primitives), mailboxes_(options.mailboxes) {
    if (input.primitives.hittable_count() == 0) return;
    GridOptions chosen = options;
    const bool gather = options.gather.value_or(gathering_pays(input));
    if (!chosen.density) chosen.density = gather ? density_of_blocks : density_of_lists;
    lattice_ = build_limited_lists(input, chosen, {input.progress, 0.0, 0.6}, lists_);
    if (gather && fits_blocks(input, lists_.bytes(), lists_.references.size()))
        write_cell_blocks(input.primitives, input.parallel, {input.progress, 0.6, 1.0}, lists_);
}

GridStatistics UniformGrid::statistics() const {
    if (lattice_.number_count == 0) return {};
    const std::array<std::uint32_t, 3>& resolution = lattice_.resolution;
    std::vector<std::uint32_t> counts;
    counts.reserve(lattice_.cell_count());
    for (std::uint32_t z = 0; z < resolution[2]; ++z) {
        for (std::uint32_t y = 0; y < resolution[1]; ++y) {
            for (std::uint32_t x = 0; x < resolution[0]; ++x) counts.push_back(lists_.count(lattice_.number(x, y, z)));
        }
    }
    return grid_statistics(resolution, counts);
}

} // namespace raywise
