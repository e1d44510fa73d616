// A counting sort in two steps, so that neither misses the caches when primitives come in no order: the pairs of a block of primitives
// are parted by runs of cells, then each run's pairs by cell.
#pragma once

#include "accel/grid/cell_pairs.h"
#include "accel/grid/grid_lists.h"
#include "accel/grid/progress_part.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

namespace raywise {

namespace list_builder_detail {

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

} // namespace list_builder_detail

// What is listed comes from a Source, in blocks of less than 2^16:
//     std::uint64_t blocks() const;
//     void find_pairs(std::uint64_t block, std::size_t most, CellPairs& pairs) const;  // or some, and more than most
//     std::uint32_t primitive(std::uint64_t block, std::uint32_t place) const;  // of a pair
template <class Source>
class ListBuilder {
    // A primitive's place in a block, and a cell's in a run of cells, are half a word.
    static constexpr unsigned run_shift = 16;
    static constexpr std::uint32_t cell_mask = (1u << run_shift) - 1;

public:
    // cells: how many numbers there are. expected: pairs, about.
    ListBuilder(const Parallel& parallel, const ProgressPart& progress, const Source& source, std::uint64_t cells,
                std::uint64_t expected, std::uint64_t max_narrow_references)
        : parallel_(parallel),
          progress_(progress),
          source_(source),
          max_narrow_references_(max_narrow_references),
          cells_(cells),
          runs_(((cells_ - 1) >> run_shift) + 1),
          blocks_(source.blocks()),
          store_(expected),
          segments_(blocks_),
          run_ends_(blocks_ * runs_) {}

    bool find_pairs(std::uint64_t most) {
        std::atomic<std::uint64_t> total{0};
        std::atomic<std::uint64_t> done{0};
        list_builder_detail::work_off(parallel_, blocks_, [&](const auto& take_next) {
            CellPairs pairs;
            for (std::uint64_t block = take_next(); block < blocks_ && total <= most; block = take_next()) {
                pairs.clear();
                const std::uint64_t most_here = std::min<std::uint64_t>(most, 0xFFFFFFFFu);
                source_.find_pairs(block, most_here, pairs);
                total += pairs.size() > most_here ? most + 1 : pairs.size();
                if (total > most) return;
                part_pairs(block, pairs);
                progress_.report(0.6 * static_cast<double>(++done) / static_cast<double>(blocks_), "grid: cells");
            }
        });
        references_ = total;
        return references_ <= most;
    }

    bool is_wide() const { return references_ > max_narrow_references_; }
    std::size_t bytes() const { return GridLists::bytes_for(cells_, references_, is_wide()); }

    void sort_pairs(GridLists& lists) {
        if (is_wide()) {
            lists.wide_offsets = sort_pairs<std::uint64_t>(lists);
        } else {
            lists.narrow_offsets = sort_pairs<std::uint32_t>(lists);
        }
    }

private:
    // Run by run, each pair in one word.
    void part_pairs(std::uint64_t block, const CellPairs& pairs) {
        std::uint32_t* const ends = run_ends_.data() + block * runs_;
        const std::size_t count = pairs.size();
        std::uint32_t* const parted = store_.take(count);
        const std::uint32_t* const cells = pairs.cells();
        const std::uint32_t* const primitives = pairs.primitives();
        segments_[block] = parted;
        if (runs_ == 1) {
            for (std::size_t i = 0; i < count; ++i) parted[i] = cells[i] | primitives[i] << run_shift;
            ends[0] = static_cast<std::uint32_t>(count);
            return;
        }
        std::memset(ends, 0, runs_ * sizeof *ends);
        for (std::size_t i = 0; i < count; ++i) ++ends[cells[i] >> run_shift];
        std::uint32_t begin = 0;
        for (std::uint64_t run = 0; run < runs_; ++run) begin += std::exchange(ends[run], begin);
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t in_run = cells[i] & cell_mask;
            parted[ends[cells[i] >> run_shift]++] = in_run | primitives[i] << run_shift;
        }
    }

    // Calls visit(pairs, count, block) for each block that has some of the run.
    template <class Visit>
    void for_each_segment(std::uint64_t run, const Visit& visit) const {
        for (std::uint64_t block = 0; block < blocks_; ++block) {
            const std::uint32_t* const ends = run_ends_.data() + block * runs_;
            const std::uint32_t begin = run == 0 ? 0 : ends[run - 1];
            if (ends[run] == begin) continue;
            visit(segments_[block] + begin, ends[run] - begin, block);
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
        list_builder_detail::work_off(parallel_, runs_, [&](const auto& take_next) {
            PageArray<Offset> next(std::min(cells_, std::uint64_t{1} << run_shift));
            for (std::uint64_t run = take_next(); run < runs_; run = take_next()) {
                sort_run(run, static_cast<Offset>(run_begin[run]), next, offsets, lists);
                progress_.report(0.6 + 0.4 * static_cast<double>(++done) / static_cast<double>(runs_), "grid: lists");
            }
        });
        return offsets;
    }

    template <class Offset>
    void sort_run(std::uint64_t run, Offset begin, PageArray<Offset>& next, PageArray<Offset>& offsets,
                  GridLists& lists) const {
        const std::uint64_t first_cell = run << run_shift;
        const std::uint64_t cells = std::min(cells_ - first_cell, std::uint64_t{1} << run_shift);
        std::fill_n(next.data(), cells, Offset{0});
        for_each_segment(run, [&](const std::uint32_t* pairs, std::uint32_t count, std::uint64_t) {
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
        for_each_segment(run, [&](const std::uint32_t* pairs, std::uint32_t count, std::uint64_t block) {
            for (std::uint32_t i = 0; i < count; ++i)
                references[next[pairs[i] & cell_mask]++] = source_.primitive(block, pairs[i] >> run_shift);
        });
    }

    const Parallel& parallel_;
    const ProgressPart progress_;
    const Source& source_;
    const std::uint64_t max_narrow_references_;
    const std::uint64_t cells_;
    const std::uint64_t runs_;
    const std::uint64_t blocks_;
    list_builder_detail::PairStore store_;
    std::vector<const std::uint32_t*> segments_; // of each block
    PageArray<std::uint32_t> run_ends_;          // of each run in each block's segment
    std::uint64_t references_ = 0;
};

} // namespace raywise
