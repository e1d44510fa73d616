// Whether the caller's arrays hold what they may: passes over all of a mesh, which have to run as fast as memory is read.
#pragma once

#include <cstddef>
#include <cstdint>

namespace raywise {

// `count` packed numbers at any address. Whether each is finite, and for float64 within the range of float32.
bool all_within_float32(const std::byte* numbers, std::uint64_t count, bool float64);

// `count` packed uint32 at any address. Whether each is below `limit`.
bool all_below(const std::byte* indices, std::uint64_t count, std::uint32_t limit);

} // namespace raywise
