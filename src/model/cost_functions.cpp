#include "model/cost_functions.h"

#include "model/policy.h"

#include <algorithm>

namespace raywise {

namespace {

Cost without_blocks(const MachineConstants& constants, const Cost& cost) {
    Cost smaller = cost;
    smaller.bytes = constants.structures[Structure::linear_scan].bytes.fixed;
    return smaller;
}

Cost with_fewer_cells(const Cost& cost, const SceneFeatures& features, double bytes) {
    // A number for each triangle in its cell, more for those on an edge, and the cells.
    constexpr double least_per_triangle = 8.0;
    if (bytes < least_per_triangle * features.triangles) return cost;
    Cost smaller = cost;
    smaller.ray_ns *= cost.bytes / bytes;
    smaller.bytes = bytes;
    return smaller;
}

} // namespace

Cost within(Structure structure, const MachineConstants& constants, const Cost& cost, const SceneFeatures& features,
            double bytes) {
    if (cost.bytes <= bytes) return cost;
    switch (spared(structure)) {
        case Spared::blocks:
            return without_blocks(constants, cost);
        case Spared::cells:
            return with_fewer_cells(cost, features, bytes);
        case Spared::nothing:
            break;
    }
    return cost;
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
    if (structure == Structure::linear_scan && !worth_gathering(workload)) return without_blocks(constants, cost);
    return cost;
}

} // namespace raywise
