#include "accel/grid/grid_choice.h"

#include <algorithm>
#include <cmath>

namespace raywise {

std::array<std::uint32_t, 3> walkable_resolution(std::array<std::uint32_t, 3> resolution, const Box& bounds,
                                                 const Box& scene) {
    const double scene_size = max_component(scene.size());
    for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<glm::length_t>(a);
        const double farthest = std::max(std::fabs(scene.lower[axis]), std::fabs(scene.upper[axis]));
        const double least_width = 0x1p-25 * scene_size + 0x1p-34 * farthest;
        const double most = bounds.size()[axis] / least_width;
        if (!(resolution[a] <= most)) resolution[a] = most >= 1.0 ? static_cast<std::uint32_t>(most) : 1;
    }
    return resolution;
}

} // namespace raywise
