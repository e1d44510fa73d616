#include "model/cost_functions.h"

#include "model/policy.h"

#include <algorithm>

namespace raywise {

Cost scan_in_place(const MachineConstants& constants, const Cost& gathered) {
    const StructureConstants& lines = constants.structures[Structure::linear_scan];
    Cost cost = gathered;
    cost.build_ns = lines.build_ns.fixed;
    cost.ray_ns += gathered.build_ns - lines.build_ns.fixed;
    cost.bytes = lines.bytes.fixed;
    return cost;
}

Cost within(Structure structure, const Cost& cost, const SceneFeatures& features, double bytes) {
    // A number for each triangle in its cell, and half as much again for those on an edge, and for the cells.
    constexpr double least_per_triangle = 8.0;
    if (cost.bytes <= bytes || !shrinks(structure) || bytes < least_per_triangle * features.triangles) return cost;
    Cost smaller = cost;
    smaller.ray_ns *= cost.bytes / bytes;
    smaller.bytes = bytes;
    return smaller;
}

Cost predict(Structure structure, const MachineConstants& constants, const SceneFeatures& features,
             const Workload& workload) {
    const StructureConstants& lines = constants.structures[structure];
    const LinearCost& ray = lines.ray_ns[ray_kind_index(workload.kind)];

    Cost cost;
    cost.build_ns = lines.build_ns.at(build_units(structure), features);
    cost.ray_ns = ray.at(ray_units(structure), features);
    cost.bytes = lines.bytes.at(byte_units(structure), features);
    cost.error = std::max(lines.build_ns.residual, ray.residual);
    if (structure == Structure::linear_scan && !worth_gathering(workload)) return scan_in_place(constants, cost);
    return cost;
}

} // namespace raywise
