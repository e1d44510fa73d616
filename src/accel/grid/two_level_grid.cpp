#include "accel/grid/two_level_grid.h"

#include "accel/grid/cell_blocks.h"
#include "accel/grid/grid_choice.h"
#include "accel/grid/list_builder.h"
#include "base/page_array.h"
#include "geometry/triangle_box_overlap.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raywise {
namespace {

// Of coarse bricks that are split together. Fixed, so that the result does not depend on the number of threads.
constexpr std::uint64_t bricks_per_task = 16;
constexpr std::uint32_t references_per_block = 1u << 13;

// A primitive that is so much longer than the cell's median primitive is large.
constexpr double large_in_medians = 16.0;
// Large ones stay in the cell where the others' bounds then have less than so much of the surface.
constexpr double least_gain = 0.5;
// An inner grid in which primitives would be listed more often than that each gets fewer cells.
constexpr double most_repeats = 6.0;
// Numbers of cells of all inner grids.
constexpr std::uint64_t most_numbers = 0xFFFFFFFFu;

// What goes to the grid of a coarse cell.
struct InnerCell {
    std::uint32_t coarse;
    std::uint32_t count; // of primitives
    Box bounds;          // of what the cell's primitives reach of it
    Vec3 sizes{0.0};     // of the primitives' boxes, summed up
};

// Of some coarse bricks.
struct SplitPart {
    PageVector<std::uint32_t> own;
    PageVector<std::uint32_t> inner;
    PageVector<InnerCell> cells;
};

class CoarseSplit {
public:
    CoarseSplit(const Primitives& primitives, const TwoLevelOptions& options, const CellLattice& coarse,
                GridLists& lists)
        : primitives_(primitives),
          options_(options),
          coarse_(coarse),
          lists_(lists),
          parts_((lists.occupied.size() + bricks_per_task - 1) / bricks_per_task),
          own_counts_(coarse.number_count) {}

    void run(const BuildInput& input) {
        std::fill(own_counts_.begin(), own_counts_.end(), 0u);
        input.parallel.for_each(parts_.size(), [&](std::uint64_t task) {
            const std::uint64_t end = std::min<std::uint64_t>(lists_.occupied.size(), (task + 1) * bricks_per_task);
            split(task, task * bricks_per_task * cells_per_brick, end * cells_per_brick);
            input.progress.report(0.3, "grid: cells of cells");
        });
        std::size_t own = 0;
        std::size_t inner = 0;
        for (const SplitPart& part : parts_) {
            own += part.own.size();
            inner += part.inner.size();
        }
        lists_.references = PageArray<std::uint32_t>(own);
        inner_references_ = PageArray<std::uint32_t>(inner);
        std::uint32_t* next_own = lists_.references.data();
        std::uint32_t* next_inner = inner_references_.data();
        for (SplitPart& part : parts_) {
            next_own = std::copy(part.own.begin(), part.own.end(), next_own);
            next_inner = std::copy(part.inner.begin(), part.inner.end(), next_inner);
            cells_.insert(cells_.end(), part.cells.begin(), part.cells.end());
            part = {};
        }
        std::uint64_t begin = 0;
        for (std::uint64_t cell = 0; cell <= coarse_.number_count; ++cell) {
            set_offset(cell, begin);
            if (cell < coarse_.number_count) begin += own_counts_[cell];
        }
    }

    const PageVector<InnerCell>& cells() const { return cells_; }
    const PageArray<std::uint32_t>& inner_references() const { return inner_references_; }

private:
    void set_offset(std::uint64_t cell, std::uint64_t offset) {
        if (lists_.is_wide()) {
            lists_.wide_offsets[cell] = offset;
        } else {
            lists_.narrow_offsets[cell] = static_cast<std::uint32_t>(offset);
        }
    }

    void split(std::uint64_t task, std::uint64_t first, std::uint64_t end) {
        SplitPart& part = parts_[task];
        PageVector<Box> boxes;
        PageVector<double> lengths;
        for (std::uint64_t cell = first; cell < end; ++cell) {
            const std::uint32_t count = lists_.count(cell);
            if (count == 0) continue;
            const std::uint32_t* const list = lists_.references.data() + lists_.offset(cell);
            if (count <= options_.most_in_a_cell || !split_cell(cell, list, count, boxes, lengths, part)) {
                part.own.insert(part.own.end(), list, list + count);
                own_counts_[cell] = count;
            }
        }
    }

    // Returns false where the cell keeps all.
    bool split_cell(std::uint64_t cell, const std::uint32_t* list, std::uint32_t count, PageVector<Box>& boxes,
                    PageVector<double>& lengths, SplitPart& part) {
        boxes.clear();
        lengths.clear();
        for (std::uint32_t i = 0; i < count; ++i) {
            boxes.push_back(primitives_.box(list[i]));
            lengths.push_back(max_component(boxes.back().size()));
        }
        const double large = large_length(lengths);
        InnerCell all{static_cast<std::uint32_t>(cell), 0, {}};
        InnerCell small = all;
        for (const Box& box : boxes) {
            add(all, box);
            if (max_component(box.size()) <= large) add(small, box);
        }
        clip_to_cell(all);
        clip_to_cell(small);
        const bool set_apart = all.count - small.count <= options_.most_large_apart &&
                               small.bounds.half_area() < least_gain * all.bounds.half_area();
        const InnerCell& inner = set_apart ? small : all;
        if (inner.count <= options_.most_in_a_cell) return false;
        for (std::uint32_t i = 0; i < count; ++i) {
            const bool is_own = set_apart && max_component(boxes[i].size()) > large;
            (is_own ? part.own : part.inner).push_back(list[i]);
            own_counts_[cell] += is_own ? 1 : 0;
        }
        part.cells.push_back(inner);
        return true;
    }

    // What is longer is large.
    static double large_length(PageVector<double>& lengths) {
        const auto median = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
        std::nth_element(lengths.begin(), median, lengths.end());
        return large_in_medians * *median;
    }

    static void add(InnerCell& cell, const Box& box) {
        cell.bounds.extend(box);
        cell.sizes += box.size();
        ++cell.count;
    }

    void clip_to_cell(InnerCell& inner) const {
        const std::array<std::uint32_t, 3> place = coarse_.place(inner.coarse);
        for (int axis = 0; axis < 3; ++axis) {
            const double width = coarse_.width[axis];
            const double lower = coarse_.bounds.lower[axis] + place[static_cast<std::size_t>(axis)] * width;
            double& low = inner.bounds.lower[axis];
            double& high = inner.bounds.upper[axis];
            low = std::max(low, lower - overlap_slack * width);
            high = std::min(high, lower + (1.0 + overlap_slack) * width);
            if (high < low) low = high; // near the cell, but not in it
        }
    }

    const Primitives& primitives_;
    const TwoLevelOptions& options_;
    const CellLattice& coarse_;
    GridLists& lists_;
    PageVector<SplitPart> parts_;
    PageArray<std::uint32_t> own_counts_;
    PageArray<std::uint32_t> inner_references_;
    PageVector<InnerCell> cells_;
};

CellLattice inner_lattice(const InnerCell& cell, double density, const Box& scene) {
    const Vec3 size = cell.bounds.size();
    for (double cells = density * cell.count;; cells /= 4.0) {
        const std::array<std::uint32_t, 3> resolution =
            walkable_resolution(grid_resolution(size, cells, 1.0), cell.bounds, scene);
        double repeats = 1.0;
        for (std::size_t a = 0; a < 3; ++a) {
            const auto axis = static_cast<glm::length_t>(a);
            if (resolution[a] > 1) repeats *= 1.0 + cell.sizes[axis] / cell.count / size[axis] * resolution[a];
        }
        const CellLattice lattice(cell.bounds, resolution);
        if (lattice.cell_count() == 1 || repeats <= most_repeats) return lattice;
    }
}

// The references of all inner grids, one grid after the other.
class InnerReferences {
public:
    InnerReferences(const Primitives& primitives, const PageArray<std::uint32_t>& references,
                    const PageVector<InnerGrid>& grids, const PageVector<std::uint64_t>& ends)
        : primitives_(primitives), references_(references), grids_(grids), ends_(ends) {}

    std::uint64_t blocks() const { return (references_.size() + references_per_block - 1) / references_per_block; }
    void find_pairs(std::uint64_t block, std::size_t most, CellPairs& pairs) const {
        const std::uint64_t begin = block * references_per_block;
        const std::uint64_t end = std::min<std::uint64_t>(references_.size(), begin + references_per_block);
        auto grid = static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), begin) - ends_.begin());
        for (std::uint64_t i = begin; i < end && pairs.size() <= most; ++i) {
            while (i >= ends_[grid]) ++grid;
            add_cell_pairs(primitives_.corners(references_[i]), grids_[grid].lattice, grids_[grid].first_cell,
                           static_cast<std::uint32_t>(i - begin), most, pairs);
        }
    }
    std::uint32_t primitive(std::uint64_t block, std::uint32_t place) const {
        return references_[block * references_per_block + place];
    }

private:
    const Primitives& primitives_;
    const PageArray<std::uint32_t>& references_;
    const PageVector<InnerGrid>& grids_;
    const PageVector<std::uint64_t>& ends_; // of each grid
};

// False where there are more numbers than that.
bool make_inner_grids(const PageVector<InnerCell>& cells, double density, const Box& scene, TwoLevels& levels) {
    levels.inner.clear();
    levels.inner.reserve(cells.size());
    std::uint64_t numbers = 0;
    for (const InnerCell& cell : cells) {
        const CellLattice lattice = inner_lattice(cell, density, scene);
        if (numbers + lattice.number_count > most_numbers) return false;
        levels.inner.push_back({lattice, static_cast<std::uint32_t>(numbers)});
        numbers += lattice.number_count;
    }
    return true;
}

void build_inner_grids(const BuildInput& input, const TwoLevelOptions& options, const CoarseSplit& split,
                       TwoLevels& levels) {
    PageVector<std::uint64_t> ends;
    std::uint64_t end = 0;
    for (const InnerCell& cell : split.cells()) ends.push_back(end += cell.count);
    const std::uint64_t most = std::max<std::uint64_t>(end, max_grid_references(input.primitives.hittable_count()));
    for (double density = options.density;; density /= 4.0) { // at last each grid has one cell
        if (!make_inner_grids(split.cells(), density, input.primitives.bounds(), levels)) continue;
        const std::uint64_t numbers = levels.inner.back().first_cell + levels.inner.back().lattice.number_count;
        const InnerReferences source(input.primitives, split.inner_references(), levels.inner, ends);
        ListBuilder builder(input.parallel, {input.progress, 0.3, 0.6}, source, numbers, end * 5 / 2 + 64,
                            GridOptions{}.max_narrow_references);
        if (!builder.find_pairs(most)) continue;
        builder.sort_pairs(levels.lists);
        break;
    }
    levels.inner_of = PageArray<std::uint32_t>(levels.coarse.number_count);
    std::fill(levels.inner_of.begin(), levels.inner_of.end(), TwoLevels::no_grid);
    for (std::size_t i = 0; i < levels.inner.size(); ++i)
        levels.inner_of[split.cells()[i].coarse] = static_cast<std::uint32_t>(i);
}

TwoLevels build_levels(const BuildInput& input, const TwoLevelOptions& options) {
    TwoLevels levels;
    GridOptions coarse;
    coarse.density = options.coarse_density;
    levels.coarse = build_limited_lists(input, coarse, {input.progress, 0.0, 0.3}, levels.own);
    CoarseSplit split(input.primitives, options, levels.coarse, levels.own);
    split.run(input);
    if (!split.cells().empty()) build_inner_grids(input, options, split, levels);
    return levels;
}

} // namespace

TwoLevelGrid::TwoLevelGrid(const BuildInput& input, const TwoLevelOptions& wanted) : primitives_(input.primitives) {
    if (input.primitives.hittable_count() == 0) return;
    TwoLevelOptions options = wanted;
    for (;;) {
        levels_ = build_levels(input, options);
        if (input.memory_limit == 0 || levels_.bytes() <= input.memory_limit || options.density < 0x1p-40) break;
        options.coarse_density /= 4.0;
        options.density /= 4.0;
        options.most_in_a_cell *= options.most_in_a_cell < (1u << 28) ? 4 : 1;
    }
    const std::uint64_t references = levels_.own.references.size() + levels_.lists.references.size();
    if (!gathering_pays(input) || !fits_blocks(input, levels_.bytes(), references)) return;
    write_cell_blocks(input.primitives, input.parallel, {input.progress, 0.6, 0.7}, levels_.own);
    write_cell_blocks(input.primitives, input.parallel, {input.progress, 0.7, 1.0}, levels_.lists);
}

} // namespace raywise
