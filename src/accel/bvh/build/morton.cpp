#include "accel/bvh/build/morton.h"

#include "accel/bvh/build/radix_sort.h"

#include <algorithm>
#include <vector>

namespace raywise {
namespace {

// Equal codes in a row that are worth a finer grid: clustering looks about so far along the curve anyway.
constexpr std::uint32_t longest_run = 16;

// Each finer grid divides by 2^10 and float32 spans less than 2^280.
constexpr int most_refinements = 30;

using Key = MortonKey;

class MortonSorter {
public:
    MortonSorter(const BuildItem* items, PageArray<Key> keys, std::uint32_t count, const Parallel& parallel)
        : items_(items), parallel_(parallel), keys_(PageArray<Key>(count)), other_(std::move(keys)) {}

    PageArray<Key> sort(std::uint32_t count) {
        std::vector<Run> large;
        std::vector<Run> small;
        const auto look_closer = [&](const Run& run) {
            for_equal(run, [&](const Run& part) { (part.count > radix_sort_block ? large : small).push_back(part); });
        };
        radix_sort(other_.data(), keys_.data(), count, parallel_);
        look_closer({0, count, 0});
        while (!large.empty()) {
            const Run run = large.back();
            large.pop_back();
            sort_large(run);
            look_closer(run);
        }
        other_ = {};
        parallel_.for_blocks(small.size(), 1, [&](std::uint64_t begin, std::uint64_t end) {
            for (std::uint64_t i = begin; i < end; ++i) sort_small(small[i]);
        });
        return std::move(keys_);
    }

private:
    // Keys that a grid could not tell apart.
    struct Run {
        std::uint32_t begin;
        std::uint32_t count;
        int refinements;
    };

    Bounds bounds_of(const Run& run) const {
        Bounds bounds = Bounds::none();
        for (std::uint32_t i = 0; i < run.count; ++i) {
            bounds.extend(Bounds::of_centroid(items_[keys_[run.begin + i].index]));
        }
        return bounds;
    }

    void sort_large(const Run& run) {
        const MortonGrid grid(bounds_of(run));
        parallel_.for_blocks(run.count, radix_sort_block, [&](std::uint64_t begin, std::uint64_t end) {
            for (std::uint64_t i = run.begin + begin; i < run.begin + end; ++i) {
                const std::uint32_t index = keys_[i].index;
                other_[i] = {grid.code(Bounds::of(items_[index]).centroid()), index};
            }
        });
        radix_sort(other_.data() + run.begin, keys_.data() + run.begin, run.count, parallel_);
    }

    void sort_small(const Run& run) {
        const MortonGrid grid(bounds_of(run));
        if (!grid.divides()) return;
        Key* const keys = keys_.data() + run.begin;
        for (std::uint32_t i = 0; i < run.count; ++i)
            keys[i].code = grid.code(Bounds::of(items_[keys[i].index]).centroid());
        std::sort(keys, keys + run.count, [](const Key& a, const Key& b) {
            return a.code < b.code || (a.code == b.code && a.index < b.index);
        });
        for_equal(run, [&](const Run& part) { sort_small(part); });
    }

    // Calls body for each run of equal codes that is worth a finer grid. A grid over the run's own centroids puts the
    // lowest and the highest of an axis into different cells, so the runs become shorter unless all are at one place.
    template <class Body>
    void for_equal(const Run& run, const Body& body) const {
        if (run.refinements == most_refinements) return;
        const Key* const keys = keys_.data() + run.begin;
        for (std::uint32_t begin = 0, end = 0; begin < run.count; begin = end) {
            while (end < run.count && keys[end].code == keys[begin].code) ++end;
            if (end - begin > longest_run && (run.refinements == 0 || end - begin < run.count)) {
                body({run.begin + begin, end - begin, run.refinements + 1});
            }
        }
    }

    const BuildItem* const items_;
    const Parallel& parallel_;
    PageArray<Key> keys_;
    PageArray<Key> other_;
};

} // namespace

PageArray<MortonKey> morton_order(const BuildItem* items, PageArray<MortonKey> keys, std::uint32_t count,
                                  const Parallel& parallel) {
    return MortonSorter(items, std::move(keys), count, parallel).sort(count);
}

} // namespace raywise
