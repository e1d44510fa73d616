// The switches of the lectures: ways to build a structure that the library does not offer, because one of them is better.
#pragma once

#include "accel/accel.h"

#include <functional>
#include <memory>
#include <vector>

namespace raywise::bench {

struct SwitchRow {
    const char* structure;
    const char* name; // of the setting; the first row of a structure is what the library does
    std::function<std::unique_ptr<Accel>(const BuildInput&)> build;
};

// A file for each structure: <structure>_switches.cpp.
std::vector<SwitchRow> grid_switches();
std::vector<SwitchRow> kd_switches();

} // namespace raywise::bench
