// Primitives in the order of their Morton codes, and ranges of them, which the digits of the codes divide.
#pragma once

#include "accel/accel.h"
#include "accel/bvh/build/bounds.h"
#include "accel/bvh/build/morton.h"
#include "accel/bvh/build/morton_keys.h"
#include "accel/dense_region.h"
#include "base/page_array.h"
#include "ray/scene_frame.h"

#include <cstdint>
#include <functional>
#include <utility>

namespace raywise {

// Keys that follow each other.
struct MortonRange {
    std::uint32_t begin;
    std::uint32_t end;
    std::uint32_t
        level; // the highest digit in which codes differ: the higher, the larger the range in space; 0 where no digit does
    int finer_grids; // that the codes are of

    std::uint32_t count() const { return end - begin; }
};

class MortonRanges {
public:
    // Ranges of so few primitives are not put on a finer grid. Smaller: neighbours in a cell of the first grid may as well be together.
    static constexpr std::uint32_t fewest_on_finer_grid = 17;

    // report: called with numbers of primitives that are done, from all threads.
    MortonRanges(const BuildInput& input, const SceneFrame& frame, const DenseRegion& dense,
                 const std::function<void(std::uint64_t)>& report);

    MortonRange all() { return make(0, count_, 0); }
    // Both parts of a range. Where all codes of a part are alike, it gets others on a finer grid, as often as it takes. Any number of threads
    // may divide, each what nobody else does.
    RW_INLINE std::pair<MortonRange, MortonRange> divide(const MortonRange& range, std::uint32_t middle) {
        return {make(range.begin, middle, range.finer_grids), make(middle, range.end, range.finer_grids)};
    }

    // Behind the last one are `padding` more that may be read.
    const MortonKey* keys() const { return keys_.data(); }
    static constexpr std::uint32_t padding = 16;

private:
    // Each finer grid divides by 2^10, and float32 spans less than 2^150 in a frame.
    static constexpr int most_finer_grids = 15;

    void write_keys(const DenseRegion& dense);
    std::uint32_t hittable_between(std::uint64_t begin, std::uint64_t end) const;
    RW_INLINE MortonRange make(std::uint32_t begin, std::uint32_t end, int finer_grids) {
        const std::uint32_t differing = keys_[begin].code ^ keys_[end - 1].code;
        if (differing == 0) return make_of_one_code(begin, end, finer_grids);
        return {begin, end, level(differing, finer_grids), finer_grids};
    }
    MortonRange make_of_one_code(std::uint32_t begin, std::uint32_t end, int finer_grids);
    static std::uint32_t level(std::uint32_t differing, int finer_grids) {
        const int digits_below = (most_finer_grids - finer_grids) * morton_code_bits;
        return static_cast<std::uint32_t>(digits_below + 32 - __builtin_clz(differing));
    }
    bool refine(std::uint32_t begin, std::uint32_t end);
    Lanes in_frame(const Vec3& point) const;

    const BuildInput& input_;
    const Parallel alone_{1};
    const Primitives& primitives_;
    const SceneFrame& frame_;
    const std::function<void(std::uint64_t)>& report_;
    const std::uint32_t count_;
    PageArray<MortonKey> keys_;
    PageArray<MortonKey> other_; // for sorts
};

} // namespace raywise
