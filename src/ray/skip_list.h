// Primitives that one ray passes through without a hit.
#pragma once

#include <algorithm>
#include <cstdint>

namespace raywise {

// Sorted numbers in memory of the asker's, which outlives the query.
struct SkipList {
    const std::uint32_t* first = nullptr;
    const std::uint32_t* last = nullptr;

    bool empty() const { return first == last; }
    bool contains(std::uint32_t primitive) const { return std::binary_search(first, last, primitive); }
};

} // namespace raywise
