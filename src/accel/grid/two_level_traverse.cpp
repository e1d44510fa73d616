#include "accel/grid/two_level_grid.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/grid/two_level_traverse.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/grid/traverse-inl.h"
#include "base/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

template <class Cells, class Collector>
HWY_INLINE void walk_levels(const TwoLevels& levels, Cells own, Cells inner, const CellRay& ray,
                            const ExactRay& exact_ray, Collector& collector) {
    const BlockRay block_ray(exact_ray);
    const auto visit_coarse = [&](std::uint32_t coarse) HWY_ATTR {
        const std::uint64_t begin = levels.own.offset(coarse);
        const std::uint64_t end = levels.own.offset(coarse + 1);
        if (begin < end && own.test(block_ray, begin, end, collector)) return true;
        if (levels.inner.empty() || levels.inner_of[coarse] == TwoLevels::no_grid) return false;
        const InnerGrid& grid = levels.inner[levels.inner_of[coarse]];
        const std::uint64_t* const occupied = levels.lists.occupied.data() + grid.first_cell / cells_per_brick;
        const double end_s = ray.upper_end(collector.limit());
        return walk_cells(ray, grid.lattice, occupied, end_s, collector, [&](std::uint32_t number) HWY_ATTR {
            const std::uint64_t cell = std::uint64_t{grid.first_cell} + number;
            return inner.test(block_ray, levels.lists.offset(cell), levels.lists.offset(cell + 1), collector);
        });
    };
    walk_cells(ray, levels.coarse, levels.own.occupied.data(), ray.last, collector, visit_coarse);
}

template <class Collector>
HWY_NOINLINE void trace_levels(const TracedLevels& traced, const Ray& caller_ray, Collector& collector) {
    const Primitives& primitives = traced.primitives;
    const TwoLevels& levels = traced.levels;
    if (levels.coarse.number_count == 0 || !caller_ray.is_traceable()) return;
    const ExactRay exact_ray(caller_ray);
    const CellRay ray(exact_ray, primitives.bounds(), primitives.largest_extent());
    if (HWY_UNLIKELY(!ray.is_known())) return test_all_primitives(primitives, exact_ray, collector);
    const GridLists& own = levels.own;
    const GridLists& lists = levels.lists;
    if (!own.has_blocks()) {
        const ListedCells own_cells({primitives, levels.coarse, own, true});
        const ListedCells inner_cells({primitives, levels.coarse, lists, true});
        walk_levels(levels, own_cells, inner_cells, ray, exact_ray, collector);
    } else if (own.blocks_are_float64) {
        walk_levels(levels, BlockCells<double>(own.blocks.data()), BlockCells<double>(lists.blocks.data()), ray,
                    exact_ray, collector);
    } else {
        walk_levels(levels, BlockCells<float>(own.blocks.data()), BlockCells<float>(lists.blocks.data()), ray,
                    exact_ray, collector);
    }
}

template <class AnyRay, class Collector>
HWY_INLINE void trace(const TracedLevels& traced, const AnyRay& ray, Collector& collector) {
    trace_levels(traced, widened(ray), collector);
}

RW_RAY_KERNELS(TracedLevels)

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

RW_DISPATCH_RAY_KERNELS(TracedLevels)

} // namespace raywise
#endif
