// From measurements to the constants of the cost functions.
#pragma once

#include "model/constants.h"
#include "model/scene_features.h"

#include <array>
#include <cstddef>
#include <vector>

namespace raywise::calibration {

// One measurement: the quantities a cost grows with, as many as there are units, and the cost.
struct Point {
    std::array<double, most_cost_units> units;
    double cost; // above 0
};

// cost = fixed + the sum of per_unit[i] * units[i] with no negative part, by least squares of the logarithm of predicted over measured: twice
// too much counts the same as half, for a scene of a hundred triangles and of a million. Parts that take off less than a fiftieth of the
// misfit are left out. The residual is the root mean square of the logarithms.
LinearCost fit_cost(const std::vector<Point>& points, std::size_t units);

// What was measured on one mesh with one structure.
struct BuildMeasurement {
    Structure structure;
    SceneFeatures features;
    double ns;
    double bytes;
};
struct RayMeasurement {
    Structure structure;
    std::size_t kind; // as measured_ray_kinds
    SceneFeatures features;
    double ns; // per ray
};

struct Measurements {
    std::vector<BuildMeasurement> builds;
    std::vector<RayMeasurement> rays;
    double primitive_test_ns = 0.0; // the exact test of a triangle that is missed (exact_test.h)
};

// Whether every cost can be told: at least `fewest` different sizes for each structure and ray kind.
bool suffices(const Measurements& measurements, std::size_t fewest);

// All constants. `measurements` has to suffice for 2.
//
// hapala: eq. 7 and 8, means over the kd-tree's builds and random rays, of scenes of 500 triangles and more; the
// paper's smallest has 528.
// primitive_test_ns: as it was measured.
// node_step_ns: half the slope of the bvh's line for random rays. One more level of the tree means that a ray looks
// into both children of one more node. It contains what a larger tree costs in cache misses and in paths taken in vain;
// the quotient of both numbers steers builders, so it is kept between 1/20 and 2, the range that published tracers span
// in earnest.
MachineConstants fit(const Measurements& measurements);

} // namespace raywise::calibration
