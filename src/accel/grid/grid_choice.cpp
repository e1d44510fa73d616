#include "accel/grid/grid_choice.h"

#include "accel/grid/cell_blocks.h"

#include <algorithm>
#include <cmath>

namespace raywise {

bool gathering_pays(const BuildInput& input) {
    if (input.few_rays) return false;
    const auto primitives = static_cast<double>(input.primitives.hittable_count());
    if (input.rays && static_cast<double>(*input.rays) <= rays_for_gathering * primitives) return false;
    // Not known before the lists are there, which are coarser where there will be blocks.
    constexpr std::uint64_t references_per_primitive = 2;
    return fits_blocks(input, 0, references_per_primitive * input.primitives.hittable_count());
}

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
