// The order in which many rays are best traced: those that run through the same part of the scene in the same direction one after the
// other, so that each finds in the caches, and in the processor's branch predictions, what the one before left there.
#pragma once

#include "base/box.h"
#include "base/ray.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace raywise {

class RayOrder {
public:
    // bounds: of the scene.
    explicit RayOrder(const Box& bounds);

    // Puts the numbers 0 ... count - 1 in that order, in memory that lasts until the next call. Rays that come in such an order
    // already, as those of a camera do, stay in it.
    const std::vector<std::uint32_t>& sort(const Ray* rays, std::size_t count);

private:
    // From the least significant bits: where the ray points within its octant, the cell in which it enters the scene (interleaved, so
    // that near cells have near keys), and the octant.
    static constexpr int direction_bits = 2; // on each of two axes
    static constexpr int cell_bits = 5;      // on each of three
    static constexpr int key_bits = 2 * direction_bits + 3 * cell_bits + 3;
    static constexpr int digit_bits = key_bits / 2; // two passes of counting
    static_assert(key_bits == 2 * digit_bits);

    struct Entry {
        std::uint32_t key;
        std::uint32_t ray;
    };

    std::uint32_t key_of(const Ray& ray) const;
    bool is_in_order_already() const;
    void sort_by_digit(int shift, const std::vector<Entry>& from, std::vector<Entry>& to);

    Box bounds_;
    Vec3 cells_per_unit_;
    std::vector<Entry> entries_;
    std::vector<Entry> scratch_;
    std::vector<std::uint32_t> order_;
};

} // namespace raywise
