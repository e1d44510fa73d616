#include "accel/bvh/build/morton_ranges.h"

#include "accel/bvh/build/morton_keys.h"
#include "accel/bvh/build/radix_sort.h"
#include "accel/bvh/build/subtrees.h"

#include <algorithm>
#include <vector>

namespace raywise {
namespace {

constexpr std::uint64_t chunk_size = 16384; // primitives between two reports

// Each finer grid divides by 2^10, and float32 spans less than 2^150 in a frame.
constexpr int most_finer_grids = 15;

// Radix sort counts some thousand digits, however few keys there are.
constexpr std::uint32_t fewest_to_radix_sort = 1024;

} // namespace

MortonRanges::MortonRanges(const BuildInput& input, const SceneFrame& frame, const DenseRegion& dense,
                           const std::function<void(std::uint64_t)>& report)
    : input_(input), primitives_(input.primitives), frame_(frame), report_(report) {
    const auto count = static_cast<std::uint32_t>(primitives_.hittable_count());
    other_ = PageArray<MortonKey>(count);
    keys_ = PageArray<MortonKey>(count);
    write_keys(dense);
    radix_sort(other_.data(), keys_.data(), count, input.parallel);
}

void MortonRanges::write_keys(const DenseRegion& dense) {
    const std::uint64_t chunks = (primitives_.count() + chunk_size - 1) / chunk_size;
    std::vector<std::uint32_t> places(chunks + 1, 0); // of each chunk's first key
    for (std::uint64_t chunk = 0; chunk < chunks; ++chunk)
        places[chunk + 1] = places[chunk] + hittable_between(chunk * chunk_size, (chunk + 1) * chunk_size);
    const Bounds all{in_frame(primitives_.bounds().lower), in_frame(primitives_.bounds().upper)};
    const auto grid = MortonGrid::over_most(all, frame_.to_frame(dense.center), dense.radius * frame_.scale());
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

// The first key of the upper part is found without a jump that depends on codes: it would be guessed wrong.
std::pair<MortonRange, MortonRange> MortonRanges::divide(const MortonRange& range) {
    const std::uint32_t last = keys_[range.end - 1].code;
    const std::uint32_t differing = keys_[range.begin].code ^ last;
    if (differing == 0) return halve(range);
    const int digit = 31 - __builtin_clz(differing);
    const std::uint32_t upper = last >> digit << digit;
    const MortonKey* key = keys_.data() + range.begin;
    for (std::uint32_t count = range.count(); count > 1;) {
        const std::uint32_t half = count / 2;
        key += half & (0u - static_cast<std::uint32_t>(key[half - 1].code < upper));
        count -= half;
    }
    return at(range, static_cast<std::uint32_t>(key - keys_.data()) + (key->code < upper ? 1 : 0));
}

std::pair<MortonRange, MortonRange> MortonRanges::at(const MortonRange& range, std::uint32_t middle) {
    return {make(range.begin, middle, range.finer_grids), make(middle, range.end, range.finer_grids)};
}

MortonRange MortonRanges::make(std::uint32_t begin, std::uint32_t end, int finer_grids) {
    for (;;) {
        const std::uint32_t differing = keys_[begin].code ^ keys_[end - 1].code;
        if (differing != 0) {
            const int digits_below = (most_finer_grids - finer_grids) * morton_code_bits;
            return {begin, end, static_cast<std::uint32_t>(digits_below + 32 - __builtin_clz(differing)), finer_grids};
        }
        const bool may_refine = end - begin >= fewest_on_finer_grid && finer_grids < most_finer_grids;
        if (!may_refine || !refine(begin, end)) return {begin, end, 0, finer_grids};
        ++finer_grids;
    }
}

// Codes on a grid over these keys alone, and their order. False where all are at one place.
bool MortonRanges::refine(std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t count = end - begin;
    const Parallel& parallel = count > subtree_size ? input_.parallel : alone_;
    MortonKey* const keys = keys_.data() + begin;
    PageArray<Lanes> places(count);
    parallel.for_blocks(count, radix_sort_block, [&](std::uint64_t first, std::uint64_t last) {
        for (std::uint64_t i = first; i < last; ++i) places[i] = in_frame(primitives_.box(keys[i].index).center());
        report_(0);
    });
    Bounds bounds = Bounds::none();
    for (const Lanes& place : places) bounds.extend({place, place});
    const MortonGrid grid(bounds);
    if (!grid.divides()) return false;
    for (std::uint32_t i = 0; i < count; ++i) keys[i].code = grid.code(places[i]);
    if (count < fewest_to_radix_sort) {
        const auto number = [](const MortonKey& key) { return std::uint64_t{key.code} << 32 | key.index; };
        std::sort(keys, keys + count, [&](const MortonKey& a, const MortonKey& b) { return number(a) < number(b); });
    } else {
        MortonKey* const other = other_.data() + begin;
        std::copy(keys, keys + count, other);
        radix_sort(other, keys, count, parallel);
    }
    return true;
}

Lanes MortonRanges::in_frame(const Vec3& point) const {
    const Vec3f p(frame_.to_frame(point));
    return Lanes{p.x, p.y, p.z, 0.0f};
}

} // namespace raywise
