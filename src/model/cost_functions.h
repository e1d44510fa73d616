// What a structure will cost: build, ray and bytes as functions of the scene's features.
#pragma once

#include "model/constants.h"
#include "model/cost_units.h"
#include "model/scene_features.h"
#include "model/workload.h"

namespace raywise {

struct Cost {
    double build_ns = 0.0;
    double ray_ns = 0.0; // per ray
    double bytes = 0.0;
    double error = 0.0; // relative; the larger residual of build and ray

    double total_ns(double rays) const { return build_ns + rays * ray_ns; }
};

// The same structure within so many bytes, where what it can do without is enough; else it stays as it is. A scan without blocks takes as long, as a
// batch reads the caller's arrays once for many rays. Cells of a grid are fewer, and what each holds, which is what a ray's time goes into,
// grows as they do.
Cost within(Structure structure, const MachineConstants& constants, const Cost& cost, const SceneFeatures& features,
            double bytes);

Cost predict(Structure structure, const MachineConstants& constants, const SceneFeatures& features,
             const Workload& workload);

} // namespace raywise
