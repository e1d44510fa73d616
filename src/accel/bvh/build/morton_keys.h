// Codes on a grid straight from the caller's arrays.
#pragma once

#include "accel/bvh/build/morton.h"
#include "geometry/primitives.h"
#include "ray/scene_frame.h"

#include <cstdint>

namespace raywise {

// Which triangles are much larger than most. They must not be beside small ones, whose boxes would become as large: the two digits above
// those of the grid tell how large a triangle is. Without them trees of tree, stadium, gears and interior cost 1.50, 1.66, 1.49 and 1.27 times
// as much as bvh's, with them 1.00, 1.06, 1.29 and 1.20; limits of 16 and of 64 times the median, and four times from one to the next, do
// worse on one of these or on the sphereflake (1.39 without, 1.43 with). Where triangles are alike, nothing changes. By the surface area
// heuristic; scenes of make bench, 2026-12-01.
struct SizeLimits {
    static constexpr int classes = 4;
    static constexpr double above_typical = 32.0;
    static constexpr double ratio = 8.0;

    // typical: extent of a triangle.
    explicit SizeLimits(double typical) {
        double limit = above_typical * typical;
        for (float& each : limits) {
            each = static_cast<float>(limit);
            limit *= ratio;
        }
    }
    float limits[classes - 1];
};
inline constexpr int morton_code_bits = 3 * MortonGrid::bits_per_axis + 2;

// Writes the keys of those primitives first ... end - 1 that can be hit, in their order. Codes are those of the middles of their boxes, below
// their sizes; grid and sizes are in the coordinates of the frame.
void write_morton_keys(const Primitives& primitives, std::uint32_t first, std::uint32_t end, const SceneFrame& frame,
                       const MortonGrid& grid, const SizeLimits& sizes, MortonKey* keys);

} // namespace raywise
