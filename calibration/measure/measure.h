// Runs a plan against the library: every structure, ray kind and mesh.
#pragma once

#include "measure/fit.h"
#include "measure/noise.h"
#include "measure/plan.h"

#include <cstdint>
#include <functional>

namespace raywise::calibration {

struct MeasureResult {
    Measurements measurements;
    Noise noise;
    double seconds = 0.0;
    std::size_t meshes = 0; // done
    bool out_of_time = false;
};

// progress: called with a fraction from 0 to 1 and what is going on.
using MeasureProgress = std::function<void(double fraction, const std::string& stage)>;

// threads: for builds and rays alike; constants are meant for 1.
MeasureResult measure(const Plan& plan, std::uint32_t threads, const MeasureProgress& progress);

} // namespace raywise::calibration
