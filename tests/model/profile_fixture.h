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
    const auto line = [&next] {
        next += 0.37;
        return CostLine{next * 10.0, next, next / 100.0};
    };
    for (const Structure structure : all_structures()) {
        StructureConstants& constants = profile.constants.structures[structure];
        constants.build_ns = line();
        for (CostLine& ray : constants.ray_ns) ray = line();
        constants.bytes = line();
    }
    profile.constants.hapala = {61.5, 47.25};
    profile.constants.primitive_test_ns = 11.5;
    profile.constants.node_step_ns = 4.75;
    return profile;
}

} // namespace raywise
