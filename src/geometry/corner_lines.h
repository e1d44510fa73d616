// Corners of many triangles in float32, in lines that vector registers can take in.
#pragma once

#include "base/vec.h"

#include <cstddef>

namespace raywise {

// Sixteen triangles to a block, as many as the widest registers compare at once: nine lines of sixteen numbers, x y z of the first
// corners, then of the second and the third.
inline constexpr std::size_t corner_block = 16;
inline constexpr std::size_t corner_block_numbers = 9 * corner_block;

inline std::size_t corner_blocks_for(std::size_t triangles) { return (triangles + corner_block - 1) / corner_block; }

// Which coordinates are kept: (p - center) * scale, a power of two.
struct CornerFrame {
    Vec3 center{0.0};
    double scale = 1.0;
};

} // namespace raywise
