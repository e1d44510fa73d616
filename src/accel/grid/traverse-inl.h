// Rays through a grid. Why the walk loses no hit: cell_walk.h.
//
// For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_GRID_TRAVERSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_GRID_TRAVERSE_INL_H_
#undef RAYWISE_ACCEL_GRID_TRAVERSE_INL_H_
#else
#define RAYWISE_ACCEL_GRID_TRAVERSE_INL_H_
#endif

#include "accel/grid/cell_walk.h"
#include "accel/grid/traverse.h"
#include "accel/primitive_test-inl.h"
#include "accel/primitive_test.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {

// The primitives tested last, each at the place its number says (a mailbox, as in Amanatides and Woo 1987, but on
// the stack, as many threads ask at once): one that reaches into several cells is tested once for most of them.
class Mailboxes {
public:
    Mailboxes() { tested_.fill(PrimitiveHit::no_primitive); }
    // Whether the primitive was tested already, as far as is known; from now on it was.
    HWY_INLINE bool replace(std::uint32_t primitive) {
        std::uint32_t& box = tested_[primitive % tested_.size()];
        if (box == primitive) return true;
        box = primitive;
        return false;
    }

private:
    std::array<std::uint32_t, 8> tested_;
};

// One copy for each collector: it is long.
template <class Collector>
HWY_NOINLINE bool test_list(const Primitives& primitives, const BlockRay& ray, const std::uint32_t* list,
                            std::size_t count, Collector& collector) {
    return test_listed(primitives, ray, list, count, collector);
}

// Cells with lists of primitives.
class ListedCells {
public:
    explicit ListedCells(const TracedGrid& grid)
        : primitives_(grid.primitives), has_mailboxes_(grid.mailboxes), references_(grid.lists.references.data()) {}

    // The primitives of a cell. Returns whether the collector wants no more.
    template <class Collector>
    HWY_INLINE bool test(const BlockRay& ray, std::uint64_t begin, std::uint64_t end, Collector& collector) {
        if (!has_mailboxes_) return test_list(primitives_, ray, references_ + begin, end - begin, collector);
        while (begin < end) {
            std::uint32_t untested[triangle_block_size];
            std::uint32_t n = 0;
            for (; begin < end && n < triangle_block_size; ++begin) {
                untested[n] = references_[begin];
                n += mailboxes_.replace(references_[begin]) ? 0 : 1;
            }
            if (n >= fewest_to_gather) {
                if (test_list(primitives_, ray, untested, n, collector)) return true;
                continue;
            }
            for (std::uint32_t i = 0; i < n; ++i) {
                PrimitiveHit hit;
                if (primitives_.test(ray.ray, untested[i], hit) && collector.collect(hit)) return true;
            }
        }
        return false;
    }

private:
    const Primitives& primitives_;
    bool has_mailboxes_;
    const std::uint32_t* references_;
    Mailboxes mailboxes_;
};

// Cells with blocks of triangles, which are tested as they are.
template <class T>
class BlockCells {
public:
    explicit BlockCells(const std::byte* blocks) : blocks_(blocks) {}

    template <class Collector>
    HWY_INLINE bool test(const BlockRay& ray, std::uint64_t begin, std::uint64_t end, Collector& collector) const {
        for (; begin < end; begin += triangle_block_size) {
            const auto n = static_cast<std::uint32_t>(std::min<std::uint64_t>(triangle_block_size, end - begin));
            const TriangleBlock<T> block(blocks_ + begin * TriangleBlock<T>::bytes_per_triangle, n);
            if (test_triangle_block(ray, block, farthest_corner(block, ray.ray.origin), collector)) return true;
        }
        return false;
    }

private:
    const std::byte* blocks_;
};

// Calls visit(number) for each cell in use that the ray passes, up to end_s and the collector's limit, until that returns true. Returns
// whether it did. occupied: a word for each of the lattice's bricks.
template <class Collector, class Visit>
HWY_INLINE bool walk_cells(const CellRay& ray, const CellLattice& lattice, const std::uint64_t* occupied, double end_s,
                           const Collector& collector, const Visit& visit) {
    BrickWalk bricks(ray, lattice);
    bricks.end_at(end_s);
    if (!bricks.enters()) return false;
    double limit = collector.limit();
    do {
        const std::uint64_t cells_in_use = occupied[bricks.brick()];
        if (cells_in_use == 0) continue;
        CellWalk cells = bricks.cells();
        do {
            if ((cells_in_use >> cells.cell() & 1u) == 0) continue;
            if (visit(bricks.brick() * cells_per_brick + cells.cell())) return true;
            if (collector.limit() < limit) {
                limit = collector.limit();
                bricks.end_at(ray.upper_end(limit));
                cells.end_at(bricks.last_s());
            }
        } while (cells.step());
    } while (bricks.step());
    return false;
}

template <class Cells, class Collector>
HWY_INLINE void walk_grid(const TracedGrid& grid, Cells cells, const CellRay& ray, const ExactRay& exact_ray,
                          Collector& collector) {
    const BlockRay block_ray(exact_ray);
    const GridLists& lists = grid.lists;
    walk_cells(ray, grid.lattice, lists.occupied.data(), ray.last, collector, [&](std::uint32_t cell) HWY_ATTR {
        return cells.test(block_ray, lists.offset(cell), lists.offset(cell + 1), collector);
    });
}

template <class Collector>
HWY_NOINLINE void trace_grid(const TracedGrid& grid, const Ray& caller_ray, Collector& collector) {
    if (grid.lattice.number_count == 0 || !caller_ray.is_traceable()) return;
    const ExactRay exact_ray(caller_ray);
    const CellRay ray(exact_ray, grid.primitives.bounds(), grid.primitives.largest_extent());
    if (HWY_UNLIKELY(!ray.is_known())) return test_all_primitives(grid.primitives, exact_ray, collector);
    if (!grid.lists.has_blocks()) {
        walk_grid(grid, ListedCells(grid), ray, exact_ray, collector);
    } else if (grid.lists.blocks_are_float64) {
        walk_grid(grid, BlockCells<double>(grid.lists.blocks.data()), ray, exact_ray, collector);
    } else {
        walk_grid(grid, BlockCells<float>(grid.lists.blocks.data()), ray, exact_ray, collector);
    }
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
