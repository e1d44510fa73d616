// Primitives in the order of their Morton codes, and ranges of them, which the digits of the codes divide.
#pragma once

#include "accel/accel.h"
#include "accel/bvh/build/bounds.h"
#include "accel/bvh/build/morton.h"
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

    MortonRange all() { return make(0, static_cast<std::uint32_t>(keys_.size()), 0); }
    // In two, by the highest digit in which codes differ, or by number where none does. Where all codes of a part are alike, it
    // gets others on a finer grid, as often as it takes. Any number of threads may divide, each what nobody else does.
    std::pair<MortonRange, MortonRange> divide(const MortonRange& range);
    std::pair<MortonRange, MortonRange> halve(const MortonRange& range) {
        return at(range, range.begin + range.count() / 2);
    }

    std::uint32_t primitive(std::uint32_t i) const { return keys_[i].index; }

private:
    void write_keys(const DenseRegion& dense);
    std::uint32_t hittable_between(std::uint64_t begin, std::uint64_t end) const;
    MortonRange make(std::uint32_t begin, std::uint32_t end, int finer_grids);
    std::pair<MortonRange, MortonRange> at(const MortonRange& range, std::uint32_t middle);
    bool refine(std::uint32_t begin, std::uint32_t end);
    Lanes in_frame(const Vec3& point) const;

    const BuildInput& input_;
    const Parallel alone_{1};
    const Primitives& primitives_;
    const SceneFrame& frame_;
    const std::function<void(std::uint64_t)>& report_;
    PageArray<MortonKey> keys_;
    PageArray<MortonKey> other_; // for sorts
};

} // namespace raywise
