// A part of a batch's rays that are put in order together, by their keys (ray_key.h), where that pays.
//
// In that order the caller's arrays would be read all over the place: up to four cache lines for each ray, in pages of 4 KiB, whose addresses
// no table of the processor holds any more by then. So while keys are made, which takes reading every ray, each is copied into memory that
// has none of that: half a line, in pages of 2 MiB. Answers go straight to the caller's arrays.
#pragma once

#include "base/page_array.h"
#include "base/parallel.h"
#include "batch/batch_progress.h"
#include "batch/elements.h"
#include "batch/ray_arrays.h"
#include "batch/ray_order.h"
#include "geometry/primitives.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <type_traits>

namespace raywise {

// What windows take, kept from one to the next.
struct WindowMemory {
    RayOrder order;
    std::tuple<PageArray<Ray>, PageArray<RayF>> copies; // one is in use
};

// AnyRay: what the rays are read as, RayF or Ray.
template <class AnyRay>
class RayWindow {
public:
    // bounds: of the scene.
    RayWindow(const RayArrays& rays, const Box& bounds, const Parallel& parallel, BatchProgress& progress,
              WindowMemory& memory)
        : rays_(rays),
          keys_(bounds),
          parallel_(parallel),
          progress_(progress),
          order_(memory.order),
          copies_(std::get<PageArray<AnyRay>>(memory.copies)) {}

    // Whether most of the rays first ... first + count - 1 are in the cell and octant of the one before, as a camera's are.
    bool come_in_order(std::uint64_t first, std::size_t count) const;

    // Moves to those rays. sorted: in the order of their keys.
    void move_to(std::uint64_t first, std::size_t count, bool sorted);
    const Elements& elements() const { return elements_; }
    bool is_sorted() const { return is_sorted_; }

    // The rays of a part of elements(). Different threads may read different parts.
    void read(const Elements& part, AnyRay* rays) const;

    // Of a sorted window: keeps the hits of a part, whose rays have been read, and calls write(elements, hits) for all that were kept, in the order
    // of the caller's arrays, on several threads.
    void keep(const Elements& part, const PrimitiveHit* hits);
    template <class Write>
    void write_kept(const Write& write);

private:
    static_assert(sizeof(PrimitiveHit) <= sizeof(AnyRay) && std::is_trivially_copyable_v<PrimitiveHit>);

    PrimitiveHit kept(std::size_t number) const {
        PrimitiveHit hit;
        std::memcpy(static_cast<void*>(&hit), copies_.data() + number, sizeof hit);
        return hit;
    }
    const std::uint32_t* sort(std::uint64_t first, std::size_t count);

    const RayArrays& rays_;
    const RayKeys keys_;
    const Parallel& parallel_;
    BatchProgress& progress_;
    RayOrder& order_;
    PageArray<AnyRay>& copies_; // of a sorted window, in the order of the caller's arrays
    std::uint64_t first_ = 0;
    bool is_sorted_ = false;
    Elements elements_{0, 0};
};

template <class AnyRay>
template <class Write>
void RayWindow<AnyRay>::write_kept(const Write& write) {
    constexpr std::size_t at_once = 512; // stay in the first-level cache
    parallel_.for_blocks(elements_.count(), 32 * at_once, [&](std::uint64_t block_begin, std::uint64_t block_end) {
        PrimitiveHit hits[at_once];
        for (std::size_t begin = block_begin; begin < block_end; begin += at_once) {
            progress_.poll();
            const std::size_t n = std::min<std::size_t>(at_once, block_end - begin);
            for (std::size_t k = 0; k < n; ++k) hits[k] = kept(begin + k);
            write(Elements(first_ + begin, n), hits);
        }
    });
}

} // namespace raywise
