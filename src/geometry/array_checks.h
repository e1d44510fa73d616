// Whether the caller's arrays hold what they may: passes over all of a mesh, which have to run as fast as memory is read.
#pragma once

#include "base/box.h"

#include <cstddef>
#include <cstdint>

namespace raywise {

// `count` points of three packed numbers, at any address. Whether each number is finite, and for float64 within the range of float32; then
// `bounds` is extended by all of them.
bool bound_points(const std::byte* points, std::uint64_t count, bool float64, Box& bounds);

// `count` packed uint32 at any address. Whether each is below `limit`.
bool all_below(const std::byte* indices, std::uint64_t count, std::uint32_t limit);

} // namespace raywise
