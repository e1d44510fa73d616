// Equal cells of a box, and their numbers.
//
// Cells are numbered brick by brick, and within a brick along x, then y, then z: what lies near a cell has a near number, so a ray's steps
// stay within few cache lines, and what is known of a brick's 64 cells is one word. A brick has four cells along each axis, or more along
// some where the box has fewer along another. A cell's number is the sum of one number for each axis. Bricks at the end may reach beyond
// the box; the cells there have numbers, and nothing in them.
#pragma once

#include "base/box.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace raywise {

// Along one axis: what the cell's place there adds to its number.
struct AxisNumbers {
    std::uint32_t brick_shift = 0; // log2 of the brick's cells along the axis
    std::uint32_t cell_shift = 0;  // log2 of what a step within the brick adds
    std::uint32_t brick_step = 0;  // what a step from brick to brick adds

    std::uint32_t brick_mask() const { return (1u << brick_shift) - 1; }
    std::uint32_t operator()(std::uint32_t place) const {
        return (place >> brick_shift) * brick_step + ((place & brick_mask()) << cell_shift);
    }
};

inline constexpr std::uint32_t cells_per_brick = 64;

struct CellLattice {
    CellLattice() = default;
    // bounds: not empty. resolution: at least one cell along each axis, at most max_cells in all.
    CellLattice(const Box& bounds, const std::array<std::uint32_t, 3>& resolution);

    static constexpr double max_cells = 0x1p30;
    // Along an axis: what the walk's proof and the overlap test have room for.
    static constexpr double max_cells_along_axis = 0x1p24;

    Box bounds{Vec3(0.0), Vec3(0.0)};
    std::array<std::uint32_t, 3> resolution{};
    Vec3 cells_per_unit{0.0}; // 0 along an axis with one cell
    Vec3 width{0.0};          // of a cell
    std::array<AxisNumbers, 3> numbers;
    std::uint64_t number_count = 0; // all numbers are below; a multiple of cells_per_brick

    std::uint32_t number(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return numbers[0](x) + numbers[1](y) + numbers[2](z);
    }
    std::uint64_t cell_count() const { return std::uint64_t{resolution[0]} * resolution[1] * resolution[2]; }
};

// How many cells along each axis: as many as make cells cubes of which `density` times `primitives` fill the box
// (Woo's rule as Havran and Sixta 1999 use it). Axes along which the box is thinner than such a cube, or flat, have
// one cell, and the others share all.
std::array<std::uint32_t, 3> grid_resolution(const Vec3& size, double primitives, double density);

} // namespace raywise
