#include "accel/grid/uniform_grid.h"

#include <vector>

namespace raywise {
namespace {

// References beyond this many per primitive coarsen the grid: large primitives that overlap each other, for which
// smaller cells gain little.
constexpr std::uint64_t max_references_per_primitive = 24;
constexpr std::uint64_t references_always_allowed = 1u << 16;

} // namespace

UniformGrid::UniformGrid(const BuildInput& input, const GridOptions& options)
    : TraversedAccel(input.primitives), mailboxes_(options.mailboxes) {
    const Primitives& primitives = input.primitives;
    const std::uint64_t hittable = primitives.hittable_count();
    if (hittable == 0) return;
    double cells = options.density.value_or(default_density) * static_cast<double>(hittable);
    for (;;) {
        lattice_ = CellLattice(primitives.bounds(), grid_resolution(primitives.bounds().size(), cells, 1.0));
        const std::uint64_t max_references =
            lattice_.cell_count() == 1 ? hittable : hittable * max_references_per_primitive + references_always_allowed;
        if (build_grid_lists(input, lattice_, options, max_references, lists_)) break;
        cells /= 4.0; // with one cell everything fits
    }
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
