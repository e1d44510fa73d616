// A plane polygon without holes cut into triangles.
#pragma once

#include "base/vec.h"

#include <array>
#include <cstdint>
#include <vector>

namespace raywise::bench {

// Positions of three corners each; corners - 2 triangles. Ears are cut off one after the other (Meisters 1975).
std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<Vec3>& corners);

} // namespace raywise::bench
