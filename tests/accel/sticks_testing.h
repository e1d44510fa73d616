// Scenes of long thin triangles, whose boxes overlap: what is worth cutting.
#pragma once

#include "accel/bvh_testing.h"

namespace raywise::bvh_testing {

// From one end of the scene to another.
inline Triangles sticks(std::size_t count, unsigned seed, double scale = 1.0, const Vec3& center = Vec3(0.0)) {
    Random random(seed);
    Triangles triangles(count);
    for (Corners& corners : triangles) {
        const Vec3 a = random.in_cube();
        const Vec3 b = random.in_cube();
        corners = {center + scale * a, center + scale * b,
                   center + scale * (0.5 * a + 0.5 * b + random.in_cube(0.002))};
    }
    return triangles;
}

// As long as a few times the distance between neighbours: a box overlaps dozens of others, and not all.
inline Triangles short_sticks(std::size_t count, unsigned seed) {
    Random random(seed);
    Triangles triangles(count);
    for (Corners& corners : triangles) {
        const Vec3 middle = random.in_cube();
        const Vec3 along = 0.1 * random.direction();
        corners = {middle - along, middle + along, middle + along + random.in_cube(0.002)};
    }
    return triangles;
}

} // namespace raywise::bvh_testing
