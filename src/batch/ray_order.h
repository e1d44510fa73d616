// Rays put in the order of their keys, on several threads: a radix sort by the lower and then by the upper half of the key.
#pragma once

#include "base/page_array.h"
#include "base/parallel.h"
#include "batch/ray_key.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace raywise {

class RayOrder {
public:
    // Makes room for the keys of `count` rays, to be filled before sort().
    std::uint32_t* keys(std::size_t count);
    // The numbers of those rays in the order of their keys; they last until the next call of keys(). It is the same order on any number
    // of threads.
    const std::uint32_t* sort(const Parallel& parallel);

private:
    static constexpr int digit_bits = RayKeys::bits / 2;
    static_assert(RayKeys::bits == 2 * digit_bits);
    static constexpr std::uint32_t digits = 1u << digit_bits;

    struct Entry {
        std::uint32_t key;
        std::uint32_t ray;
    };
    // Rays of one thread.
    struct Part {
        std::size_t begin;
        std::size_t end;
        std::array<std::uint32_t, digits> next; // how many there are of each digit, then where the next of them goes
    };

    void divide(unsigned threads);
    // Puts each i below the count at its place by digit_of(i): place(i, where).
    template <class DigitOf, class Place>
    void sort_by(const Parallel& parallel, const DigitOf& digit_of, const Place& place);

    std::size_t count_ = 0;
    std::vector<Part> parts_;
    PageArray<std::uint32_t> keys_;
    PageArray<std::uint32_t> numbers_;
    PageArray<Entry> entries_; // in the order of the lower digit
};

} // namespace raywise
