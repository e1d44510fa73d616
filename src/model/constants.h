// Every number that decides something, as calibration measures it. All times in nanoseconds on one thread: processor
// time, which on a quiet machine is wall time.
#pragma once

#include "base/structure.h"
#include "model/cost_units.h"
#include "model/workload.h"

#include <array>
#include <cstddef>

namespace raywise {

// cost = fixed + the sum of per_unit[i] * unit i; which units a structure's cost has is said in cost_units.cpp.
struct LinearCost {
    double fixed = 0.0;
    std::array<double, most_cost_units> per_unit{}; // zero beyond the units there are
    double residual = 0.0; // root mean square of the logarithm of predicted over measured, over the calibration scenes

    double at(const CostUnits& units, const SceneFeatures& features) const {
        double cost = fixed;
        for (std::size_t i = 0; i < units.size(); ++i) cost += per_unit[i] * units[i].of(features);
        return cost;
    }
};

struct StructureConstants {
    LinearCost build_ns;
    // Per ray; shadow rays ask for any hit, the others for the closest.
    std::array<LinearCost, measured_ray_kinds.size()> ray_ns;
    LinearCost bytes;
};

// Hapala, Karlik, Havran 2011, eq. 7 and 8: means over the calibration scenes of the hierarchy's (kd-tree's) build time
// per N log2 N and time per ray per log2 N.
struct HapalaConstants {
    double build_ns_per_n_log_n = 0.0;
    double ray_ns_per_log_n = 0.0;
};

struct MachineConstants {
    PerStructure<StructureConstants> structures;
    HapalaConstants hapala;
    double primitive_test_ns = 0.0; // one ray against one triangle: for builders
    double node_step_ns = 0.0;      // one step from node to node: for builders
};

// Changes only when kernels or builders change so much that old measurements mislead, or when a structure joins the list,
// of which older files know nothing.
// 2: eight-wide bvh, gathered linear scan, batches in order. 3: bvh_quality. 4: bvh_morton and features.
inline constexpr unsigned calibration_epoch = 4;

} // namespace raywise
