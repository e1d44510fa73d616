// The rays of a batch that are put in order together. Tracing them in that order would read the caller's arrays, and write to them, all
// over the place, several cache lines for each ray. So where the order is another than theirs, rays are read one after the other, and
// wait in one cache line each; the answers come to the same place, and are written one after the other.
#pragma once

#include "base/page_array.h"
#include "base/parallel.h"
#include "batch/batch_progress.h"
#include "batch/hit_arrays.h"
#include "batch/ray_arrays.h"
#include "batch/ray_order.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <optional>
#include <type_traits>

namespace raywise {

class RayWindow {
public:
    RayWindow(const RayArrays& rays, const Primitives& primitives, const Parallel& parallel, BatchProgress& progress);

    // Moves to rays first ... first + count - 1. In order: as they are best traced; those that come so already, as a camera's do, stay
    // where they are.
    void move_to(std::uint64_t first, std::size_t count, bool in_order);
    const Elements& elements() const { return elements_; }

    // The rays of a part of elements(). Different threads may read different parts.
    void read(const Elements& part, Ray* rays);
    // What was found for them, once for each part.
    void write(const Elements& part, const Hit* found, const HitArrays& hits);
    // When all have been written.
    void finish(const HitArrays& hits) const;

private:
    // A ray, until its answer is there.
    struct alignas(64) Slot {
        template <class T>
        void put(const T& value) {
            static_assert(sizeof(T) <= sizeof bytes && std::is_trivially_copyable_v<T>);
            std::memcpy(bytes, &value, sizeof value);
        }
        template <class T>
        const T& get() const { // what was put last
            return *std::launder(reinterpret_cast<const T*>(bytes));
        }

        std::byte bytes[64];
    };

    // With the normal, where that is wanted: the triangle is still at hand when the answer is put here.
    struct Answer {
        Hit hit;
        Vec3 normal{0.0};
    };

    bool come_in_order(std::uint64_t first, std::size_t count) const;
    void read_to_slots(std::uint64_t first, std::size_t count);
    std::size_t slot(const Elements& part, std::size_t k) const { return part[k] - first_; }

    const RayArrays& rays_;
    const Primitives& primitives_;
    const Parallel& parallel_;
    BatchProgress& progress_;
    std::optional<RayKeys> keys_; // of a window in order
    RayOrder order_;
    PageArray<Slot> slots_; // in the order of the caller's arrays
    std::uint64_t first_ = 0;
    bool has_slots_ = false;
    Elements elements_{0, 0};
};

} // namespace raywise
