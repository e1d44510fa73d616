// A valid profile of this machine in which every number is different.
#pragma once

#include "model/profile.h"

namespace raywise {

inline Profile sample_profile() {
    Profile profile;
    profile.machine = this_machine();
    profile.provenance = {
        "raywise-calibrate test", "raywise-calibrate measure --quick", "2026-11-22T10:20:30Z", "quick", 0.021, 4.5};
    double next = 1.0;
    const auto cost_over = [&next](const CostUnits& units) {
        LinearCost cost;
        next += 0.37;
        cost.fixed = next * 10.0;
        for (std::size_t i = 0; i < units.size(); ++i) cost.per_unit[i] = next + 0.01 * static_cast<double>(i);
        cost.residual = next / 100.0;
        return cost;
    };
    for (const Structure structure : all_structures()) {
        StructureConstants& constants = profile.constants.structures[structure];
        constants.build_ns = cost_over(build_units(structure));
        for (LinearCost& ray : constants.ray_ns) ray = cost_over(ray_units(structure));
        constants.bytes = cost_over(byte_units(structure));
    }
    profile.constants.hapala = {61.5, 47.25};
    profile.constants.primitive_test_ns = 11.5;
    profile.constants.node_step_ns = 4.75;
    return profile;
}

} // namespace raywise
