// Which cells of a lattice triangles lie in, eight or sixteen triangles at a time: the first half of building a grid.
//
// A triangle is named in each cell that it comes nearer to than half of overlap_slack cells, as the walk's proof wants it (cell_walk.h):
// the cells of its bounding box, moved apart by that slack and by what float32 may be off by, or fewer of them where the exact test is
// asked for.
#pragma once

#include "accel/grid/cell_lattice.h"
#include "accel/grid/grid_options.h"
#include "base/page_array.h"
#include "geometry/primitives.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace raywise {

// References on their way to their cells.
class CellPairs {
public:
    std::size_t size() const { return size_; }
    void clear() { size_ = 0; }
    const std::uint32_t* cells() const { return cells_.data(); }
    const std::uint32_t* primitives() const { return primitives_.data(); }

    // Where the next `count` go, with as much room behind them as whole vectors take.
    struct Room {
        std::uint32_t* cells;
        std::uint32_t* primitives;
    };
    Room make_room(std::size_t count) {
        if (cells_.size() < size_ + count + vector_room) grow(size_ + count + vector_room);
        return {cells_.data() + size_, primitives_.data() + size_};
    }
    void add(std::size_t count) { size_ += count; }

private:
    static constexpr std::size_t vector_room = 16;
    void grow(std::size_t least);

    PageArray<std::uint32_t> cells_;
    PageArray<std::uint32_t> primitives_;
    std::size_t size_ = 0;
};

// Adds the pairs of the hittable primitives first ... end - 1, or those of some of them and more than `most`. Primitives are named by
// their distance from first. lattice: over the bounds of the primitives.
void find_cell_pairs(const Primitives& primitives, std::uint32_t first, std::uint32_t end, const CellLattice& lattice,
                     OverlapTest overlap_test, std::size_t most, CellPairs& pairs);

} // namespace raywise
