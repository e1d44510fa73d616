// Morton keys in the order of their codes.
#pragma once

#include "accel/bvh/build/morton.h"
#include "base/parallel.h"

#include <cstdint>

namespace raywise {

// Keys a thread sorts on its own.
inline constexpr std::uint32_t radix_sort_block = 65536;

// Least significant digit first, stable. The sorted keys are in `other`.
void radix_sort(MortonKey* keys, MortonKey* other, std::uint32_t count, const Parallel& parallel);

} // namespace raywise
