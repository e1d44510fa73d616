#include "accel/grid/cell_lattice.h"

#include <algorithm>
#include <cmath>

namespace raywise {
namespace {

// log2 of a brick's cells along each axis, six in all: as even as the lattice is, and no more along an axis than it has cells.
std::array<std::uint32_t, 3> brick_shifts(const std::array<std::uint32_t, 3>& resolution) {
    std::array<std::uint32_t, 3> shifts{};
    for (int bit = 0; bit < 6; ++bit) {
        // The axis with the most bricks left among those with the fewest bits; where all have one brick it does not matter.
        std::size_t best = 0;
        const auto is_better = [&](std::size_t a, std::size_t b) {
            const bool a_divides = (resolution[a] - 1) >> shifts[a] != 0;
            const bool b_divides = (resolution[b] - 1) >> shifts[b] != 0;
            return a_divides != b_divides ? a_divides : shifts[a] < shifts[b];
        };
        for (std::size_t axis = 1; axis < 3; ++axis) {
            if (is_better(axis, best)) best = axis;
        }
        ++shifts[best];
    }
    return shifts;
}

} // namespace

CellLattice::CellLattice(const Box& box, const std::array<std::uint32_t, 3>& cells) : bounds(box), resolution(cells) {
    const Vec3 size = bounds.size();
    const std::array<std::uint32_t, 3> shifts = brick_shifts(resolution);
    std::uint32_t cell_shift = 0;
    std::uint64_t brick_step = cells_per_brick;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<glm::length_t>(a);
        const double count = resolution[a];
        width[axis] = size[axis] / count;
        cells_per_unit[axis] = count > 1.0 ? count / size[axis] : 0.0;
        numbers[a] = {shifts[a], cell_shift, static_cast<std::uint32_t>(brick_step)};
        cell_shift += shifts[a];
        brick_step *= ((resolution[a] - 1) >> shifts[a]) + 1;
    }
    number_count = brick_step;
}

std::array<std::uint32_t, 3> grid_resolution(const Vec3& size, double primitives, double density) {
    const double wanted = std::clamp(primitives * density, 1.0, CellLattice::max_cells);
    const double largest = max_component(size);
    std::array<std::uint32_t, 3> resolution{1, 1, 1};
    if (!(largest > 0x1p-900)) return resolution; // a point, or too small for the inverse of a cell's width
    // In units of the largest size, so that volumes neither over- nor underflow.
    const Vec3 relative = size / largest;
    std::array<bool, 3> divided{};
    for (int axis = 0; axis < 3; ++axis) divided[static_cast<std::size_t>(axis)] = relative[axis] > 0.0;
    for (;;) {
        // Cells per unit, if the divided axes share all cells: the root of wanted / volume. In logarithms, as a thin
        // box's volume may be tiny.
        double logarithm = std::log2(wanted);
        int axes = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (!divided[static_cast<std::size_t>(axis)]) continue;
            logarithm -= std::log2(relative[axis]);
            ++axes;
        }
        const double scale = std::exp2(logarithm / axes);
        bool thin = false;
        for (int axis = 0; axis < 3; ++axis) {
            auto&& is_divided = divided[static_cast<std::size_t>(axis)];
            if (is_divided && relative[axis] * scale < 1.0) {
                is_divided = false;
                thin = true;
            }
        }
        if (thin) continue; // never all: the largest axis has at least the mean number of cells, which is 1 or more
        for (int axis = 0; axis < 3; ++axis) {
            if (!divided[static_cast<std::size_t>(axis)]) continue;
            // 2^-40: so that whole numbers come out whole.
            resolution[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(
                std::clamp(relative[axis] * scale * (1.0 + 0x1p-40), 1.0, CellLattice::max_cells_along_axis));
        }
        return resolution;
    }
}

} // namespace raywise
