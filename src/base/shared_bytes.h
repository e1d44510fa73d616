// Whether two arrays in the caller's memory have a byte in common, told from where they begin and their strides: the numbers in
// them are not walked.
#pragma once

#include <cstddef>
#include <cstdint>

namespace raywise {

// Component c of element i takes `size` bytes from address + i * stride + c * component_stride on.
struct ByteLayout {
    std::uintptr_t address = 0;
    std::uint64_t count = 0; // of elements
    std::int64_t stride = 0;
    int components = 1;
    std::int64_t component_stride = 0;
    std::size_t size = 0; // of a number: 1 to 8

    bool is_empty() const { return count == 0; }
};

// True when some number of the one and some number of the other share a byte. Arrays whose bytes alternate share none.
bool share_bytes(const ByteLayout& one, const ByteLayout& other);

} // namespace raywise
