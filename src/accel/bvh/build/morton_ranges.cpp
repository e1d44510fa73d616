#include "accel/bvh/build/morton_ranges.h"

#include "accel/bvh/build/radix_sort.h"
#include "accel/bvh/build/subtrees.h"

#include <algorithm>
#include <vector>

namespace raywise {
namespace {

constexpr std::uint64_t chunk_size = 16384; // primitives between two reports

} // namespace

MortonRanges::MortonRanges(const BuildInput& input, const SceneFrame& frame, const DenseRegion& dense,
                           const std::function<void(std::uint64_t)>& report)
    : input_(input),
      primitives_(input.primitives),
      frame_(frame),
      report_(report),
      count_(static_cast<std::uint32_t>(primitives_.hittable_count())),
      keys_(std::size_t{count_} + padding),
      other_(count_) {
    write_keys(dense);
    radix_sort(other_.data(), keys_.data(), count_, input.parallel);
}

void MortonRanges::write_keys(const DenseRegion& dense) {
    const std::uint64_t chunks = (primitives_.count() + chunk_size - 1) / chunk_size;
    std::vector<std::uint32_t> places(chunks + 1, 0); // of each chunk's first key
    for (std::uint64_t chunk = 0; chunk < chunks; ++chunk)
        places[chunk + 1] = places[chunk] + hittable_between(chunk * chunk_size, (chunk + 1) * chunk_size);
    const MortonGrid grid({in_frame(dense.most.lower), in_frame(dense.most.upper)});
    const SizeLimits sizes(dense.extent * frame_.scale());
    input_.parallel.for_each(chunks, [&](std::uint64_t chunk) {
        const std::uint64_t begin = chunk * chunk_size;
        const std::uint64_t end = std::min<std::uint64_t>(primitives_.count(), begin + chunk_size);
        write_morton_keys(primitives_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), frame_, grid,
                          sizes, other_.data() + places[chunk]);
        report_(places[chunk + 1] - places[chunk]);
    });
}

std::uint32_t MortonRanges::hittable_between(std::uint64_t begin, std::uint64_t end) const {
    end = std::min<std::uint64_t>(end, primitives_.count());
    if (primitives_.hittable_count() == primitives_.count()) return static_cast<std::uint32_t>(end - begin);
    std::uint32_t count = 0;
    for (std::uint64_t i = begin; i < end; ++i) count += primitives_.is_hittable(static_cast<std::uint32_t>(i)) ? 1 : 0;
    return count;
}

MortonRange MortonRanges::make_of_one_code(std::uint32_t begin, std::uint32_t end, int finer_grids) {
    while (end - begin >= fewest_on_finer_grid && finer_grids < most_finer_grids && refine(begin, end)) {
        ++finer_grids;
        const std::uint32_t differing = keys_[begin].code ^ keys_[end - 1].code;
        if (differing != 0) return {begin, end, level(differing, finer_grids), finer_grids};
    }
    return {begin, end, 0, finer_grids};
}

// Codes on a grid over these keys alone, and their order. False where all are at one place.
bool MortonRanges::refine(std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t count = end - begin;
    const Parallel& parallel = count > subtree_size ? input_.parallel : alone_;
    MortonKey* const keys = keys_.data() + begin;
    PageArray<float> middles(middle_lines_size(count));
    parallel.for_blocks((count + middles_at_once - 1) / middles_at_once, radix_sort_block / middles_at_once,
                        [&](std::uint64_t first, std::uint64_t last) {
                            const auto begin_here = static_cast<std::uint32_t>(first * middles_at_once);
                            const auto end_here = static_cast<std::uint32_t>(last * middles_at_once);
                            write_middles(primitives_, frame_, keys + begin_here,
                                          std::min(end_here, count) - begin_here,
                                          middles.data() + middle_lines_size(begin_here));
                            report_(0);
                        });
    if (!write_codes(middles.data(), count, keys)) return false;
    MortonKey* const other = other_.data() + begin;
    std::copy(keys, keys + count, other);
    radix_sort(other, keys, count, parallel);
    return true;
}

Lanes MortonRanges::in_frame(const Vec3& point) const {
    const Vec3f p(frame_.to_frame(point));
    return Lanes{p.x, p.y, p.z, 0.0f};
}

} // namespace raywise
