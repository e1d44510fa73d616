#include "accel/grid/grid_choice.h"
#include "accel/grid/list_builder.h"

namespace raywise {
namespace {

// Fixed, so that the result does not depend on the number of threads.
constexpr std::uint32_t primitives_per_block = 1u << 13;

// All primitives, in their order.
class PrimitiveBlocks {
public:
    PrimitiveBlocks(const Primitives& primitives, const CellLattice& lattice, OverlapTest overlap_test)
        : primitives_(primitives), lattice_(lattice), overlap_test_(overlap_test) {}

    std::uint64_t blocks() const { return (primitives_.count() - 1) / primitives_per_block + 1; }
    void find_pairs(std::uint64_t block, std::size_t most, CellPairs& pairs) const {
        const auto begin = primitive(block, 0);
        const std::uint32_t end = std::min(primitives_.count() - begin, primitives_per_block) + begin;
        find_cell_pairs(primitives_, begin, end, lattice_, overlap_test_, most, pairs);
    }
    std::uint32_t primitive(std::uint64_t block, std::uint32_t place) const {
        return static_cast<std::uint32_t>(block * primitives_per_block) + place;
    }

private:
    const Primitives& primitives_;
    const CellLattice& lattice_;
    OverlapTest overlap_test_;
};

// False where there are more references than that, or the lists take more than input.memory_limit although there are cells to spare.
bool build_lists(const BuildInput& input, const CellLattice& lattice, const GridOptions& options,
                 std::uint64_t max_references, const ProgressPart& progress, GridLists& lists) {
    const PrimitiveBlocks source(input.primitives, lattice, options.overlap_test);
    const std::uint64_t expected = std::uint64_t{input.primitives.count()} * 5 / 2 + 64;
    ListBuilder builder(input.parallel, progress, source, lattice.number_count, expected,
                        options.max_narrow_references);
    if (!builder.find_pairs(max_references)) return false;
    if (input.memory_limit != 0 && builder.bytes() > input.memory_limit && lattice.cell_count() > 1) return false;
    builder.sort_pairs(lists);
    return true;
}

std::array<std::uint32_t, 3> possible_resolution(const Vec3& size, std::array<std::uint32_t, 3> wanted) {
    double cells = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool is_flat = !(size[static_cast<glm::length_t>(axis)] > 0x1p-900);
        const auto most =
            static_cast<std::uint32_t>(std::min(CellLattice::max_cells_along_axis, CellLattice::max_cells / cells));
        wanted[axis] = is_flat ? 1 : std::clamp(wanted[axis], 1u, most);
        cells *= wanted[axis];
    }
    return wanted;
}

} // namespace

CellLattice build_limited_lists(const BuildInput& input, const GridOptions& options, const ProgressPart& progress,
                                GridLists& lists) {
    const Box& bounds = input.primitives.bounds();
    const std::uint64_t hittable = input.primitives.hittable_count();
    double cells = options.density.value_or(density_of_lists) * static_cast<double>(hittable);
    std::array<std::uint32_t, 3> resolution = grid_resolution(bounds.size(), cells, 1.0);
    if (options.resolution) {
        resolution = possible_resolution(bounds.size(), *options.resolution);
        cells = static_cast<double>(resolution[0]) * resolution[1] * resolution[2];
    }
    for (;;) { // with one cell everything fits
        const CellLattice lattice(bounds, walkable_resolution(resolution, bounds, bounds));
        const std::uint64_t most = lattice.cell_count() == 1 ? hittable : max_grid_references(hittable);
        if (build_lists(input, lattice, options, most, progress, lists)) return lattice;
        cells /= 4.0;
        resolution = grid_resolution(bounds.size(), cells, 1.0);
    }
}

} // namespace raywise
