// A counting sort in two steps, so that neither misses the caches when the primitives come in no order: the pairs of a block of primitives
// are parted by runs of cells, then each run's pairs by cell.
#include "accel/grid/grid_lists.h"

#include "accel/grid/cell_pairs.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

namespace raywise {
namespace {

// Fixed, so that the result does not depend on the number of threads. A primitive's place in a block, and a cell's in a run, are half
// a word.
constexpr std::uint32_t primitives_per_block = 1u << 13;
constexpr unsigned max_run_shift = 16;
constexpr std::uint32_t cell_mask = (1u << max_run_shift) - 1;

// Pairs of all blocks, in few large pieces.
class PairStore {
public:
    explicit PairStore(std::uint64_t expected) { add_piece(expected); }

    std::uint32_t* take(std::size_t count) {
        const std::lock_guard lock(mutex_);
        if (pieces_.back().size() - used_ < count) add_piece(std::max<std::uint64_t>(count, pieces_.back().size() / 2));
        used_ += count;
        return pieces_.back().data() + used_ - count;
    }

private:
    void add_piece(std::uint64_t size) {
        pieces_.emplace_back(size);
        used_ = 0;
    }

    std::mutex mutex_;
    std::vector<PageArray<std::uint32_t>> pieces_;
    std::size_t used_ = 0; // of the last one
};

// Numbers 0 ... count - 1 are handed out to workers, each of which has memory of its own.
template <class Work>
void work_off(const Parallel& parallel, std::uint64_t count, const Work& work) {
    std::atomic<std::uint64_t> next{0};
    const std::uint64_t workers = std::min<std::uint64_t>(count, parallel.threads());
    const auto take_next = [&] { return next.fetch_add(1, std::memory_order_relaxed); };
    if (workers <= 1) {
        work(take_next);
    } else {
        parallel.for_each(workers, [&](std::uint64_t) { work(take_next); });
    }
}

class ListBuilder {
public:
    ListBuilder(const BuildInput& input, const CellLattice& lattice, const GridOptions& options)
        : input_(input),
          lattice_(lattice),
          options_(options),
          cells_(lattice.number_count),
          run_shift_(max_run_shift),
          runs_(((cells_ - 1) >> run_shift_) + 1),
          blocks_((input.primitives.count() - 1) / primitives_per_block + 1),
          store_(std::uint64_t{input.primitives.count()} * 5 / 2 + 64),
          segments_(blocks_),
          run_ends_(blocks_ * runs_) {}

    bool find_pairs(std::uint64_t most) {
        std::atomic<std::uint64_t> total{0};
        std::atomic<std::uint64_t> done{0};
        work_off(input_.parallel, blocks_, [&](const auto& take_next) {
            CellPairs pairs;
            for (std::uint64_t block = take_next(); block < blocks_ && total <= most; block = take_next()) {
                find_pairs(block, most, pairs);
                total += pairs.size();
                if (total > most) return;
                part_pairs(block, pairs);
                input_.progress.report(0.6 * static_cast<double>(++done) / static_cast<double>(blocks_), "grid: cells");
            }
        });
        references_ = total;
        return references_ <= most;
    }

    bool is_wide() const { return references_ > options_.max_narrow_references; }
    std::size_t bytes() const { return GridLists::bytes_for(cells_, references_, is_wide()); }

    void sort_pairs(GridLists& lists) {
        if (is_wide()) {
            lists.wide_offsets = sort_pairs<std::uint64_t>(lists);
        } else {
            lists.narrow_offsets = sort_pairs<std::uint32_t>(lists);
        }
    }

private:
    void find_pairs(std::uint64_t block, std::uint64_t most, CellPairs& pairs) const {
        pairs.clear();
        const auto begin = static_cast<std::uint32_t>(block * primitives_per_block);
        const std::uint32_t end = std::min(input_.primitives.count() - begin, primitives_per_block) + begin;
        find_cell_pairs(input_.primitives, begin, end, lattice_, options_.overlap_test, most, pairs);
    }

    // Run by run, each pair in one word.
    void part_pairs(std::uint64_t block, const CellPairs& pairs) {
        std::uint32_t* const ends = run_ends_.data() + block * runs_;
        const std::size_t count = pairs.size();
        std::uint32_t* const parted = store_.take(count);
        const std::uint32_t* const cells = pairs.cells();
        const std::uint32_t* const primitives = pairs.primitives();
        segments_[block] = parted;
        if (runs_ == 1) {
            for (std::size_t i = 0; i < count; ++i) parted[i] = cells[i] | primitives[i] << max_run_shift;
            ends[0] = static_cast<std::uint32_t>(count);
            return;
        }
        std::memset(ends, 0, runs_ * sizeof *ends);
        for (std::size_t i = 0; i < count; ++i) ++ends[cells[i] >> run_shift_];
        std::uint32_t begin = 0;
        for (std::uint64_t run = 0; run < runs_; ++run) begin += std::exchange(ends[run], begin);
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t in_run = cells[i] & ((1u << run_shift_) - 1);
            parted[ends[cells[i] >> run_shift_]++] = in_run | primitives[i] << max_run_shift;
        }
    }

    // Calls visit(pairs, count, first primitive) for each block that has some of the run.
    template <class Visit>
    void for_each_segment(std::uint64_t run, const Visit& visit) const {
        for (std::uint64_t block = 0; block < blocks_; ++block) {
            const std::uint32_t* const ends = run_ends_.data() + block * runs_;
            const std::uint32_t begin = run == 0 ? 0 : ends[run - 1];
            if (ends[run] == begin) continue;
            visit(segments_[block] + begin, ends[run] - begin,
                  static_cast<std::uint32_t>(block * primitives_per_block));
        }
    }

    // Returns the offsets.
    template <class Offset>
    PageArray<Offset> sort_pairs(GridLists& lists) {
        std::vector<std::uint64_t> run_begin(runs_);
        std::uint64_t position = 0;
        for (std::uint64_t run = 0; run < runs_; ++run) {
            run_begin[run] = position;
            for (std::uint64_t block = 0; block < blocks_; ++block) {
                const std::uint32_t* const ends = run_ends_.data() + block * runs_;
                position += ends[run] - (run == 0 ? 0 : ends[run - 1]);
            }
        }
        lists.references = PageArray<std::uint32_t>(references_);
        lists.occupied = PageArray<std::uint64_t>(cells_ / cells_per_brick);
        PageArray<Offset> offsets(cells_ + 1);
        offsets[cells_] = static_cast<Offset>(references_);
        std::atomic<std::uint64_t> done{0};
        work_off(input_.parallel, runs_, [&](const auto& take_next) {
            PageArray<Offset> next(std::min(cells_, std::uint64_t{1} << run_shift_));
            for (std::uint64_t run = take_next(); run < runs_; run = take_next()) {
                sort_run(run, static_cast<Offset>(run_begin[run]), next, offsets, lists);
                input_.progress.report(0.6 + 0.4 * static_cast<double>(++done) / static_cast<double>(runs_),
                                       "grid: lists");
            }
        });
        return offsets;
    }

    template <class Offset>
    void sort_run(std::uint64_t run, Offset begin, PageArray<Offset>& next, PageArray<Offset>& offsets,
                  GridLists& lists) const {
        const std::uint64_t first_cell = run << run_shift_;
        const std::uint64_t cells = std::min(cells_ - first_cell, std::uint64_t{1} << run_shift_);
        std::fill_n(next.data(), cells, Offset{0});
        for_each_segment(run, [&](const std::uint32_t* pairs, std::uint32_t count, std::uint32_t) {
            for (std::uint32_t i = 0; i < count; ++i) ++next[pairs[i] & cell_mask];
        });
        for (std::uint64_t brick = 0; brick < cells / cells_per_brick; ++brick) {
            Offset* const counts = next.data() + brick * cells_per_brick;
            Offset* const begins = offsets.data() + first_cell + brick * cells_per_brick;
            std::uint64_t occupied = 0;
            for (std::uint32_t cell = 0; cell < cells_per_brick; ++cell) {
                const Offset count = counts[cell];
                occupied |= std::uint64_t{count != 0} << cell;
                begins[cell] = counts[cell] = begin;
                begin += count;
            }
            lists.occupied[first_cell / cells_per_brick + brick] = occupied;
        }
        std::uint32_t* const references = lists.references.data();
        for_each_segment(run, [&](const std::uint32_t* pairs, std::uint32_t count, std::uint32_t first) {
            for (std::uint32_t i = 0; i < count; ++i)
                references[next[pairs[i] & cell_mask]++] = first + (pairs[i] >> max_run_shift);
        });
    }

    const BuildInput& input_;
    const CellLattice& lattice_;
    const GridOptions& options_;
    const std::uint64_t cells_;
    const unsigned run_shift_;
    const std::uint64_t runs_;
    const std::uint64_t blocks_;
    PairStore store_;
    std::vector<const std::uint32_t*> segments_; // of each block
    PageArray<std::uint32_t> run_ends_;          // of each run in each block's segment
    std::uint64_t references_ = 0;
};

} // namespace

bool build_grid_lists(const BuildInput& input, const CellLattice& lattice, const GridOptions& options,
                      std::uint64_t max_references, GridLists& lists) {
    ListBuilder builder(input, lattice, options);
    if (!builder.find_pairs(max_references)) return false;
    if (input.memory_limit != 0 && builder.bytes() > input.memory_limit && lattice.cell_count() > 1) return false;
    builder.sort_pairs(lists);
    return true;
}

} // namespace raywise
