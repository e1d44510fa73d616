#include "contract/expand.h"

#include "contract/meshes.h"
#include "contract/sweeps.h"

namespace raywise::contract {

ExpandedCase expand(const Case& source, std::uint64_t sweep_factor) {
    ExpandedCase expanded{&source, {}, {}};
    for (const GeometryLines& lines : source.geometries) {
        expanded.meshes.push_back(make_mesh(lines));
        expanded.meshes.back().name = source.name + " " + std::to_string(expanded.meshes.size() - 1);
    }
    for (const RayLines& lines : source.rays) {
        RayGroup group{&lines, {}};
        if (lines.sweep.empty())
            group.rays.push_back(lines.ray);
        else
            group.rays = sweep_rays(lines, expanded.meshes, source.float32, sweep_factor);
        expanded.groups.push_back(std::move(group));
    }
    return expanded;
}

} // namespace raywise::contract
