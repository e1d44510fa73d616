#include "model/hapala_rule.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raywise {
namespace {

// The paper's step 6: keeps the difference of two nearly equal ray times from vanishing. No unit; the paper's value.
constexpr double epsilon = 0.01;

} // namespace

HapalaDecision hapala_rule(const HapalaConstants& constants, double triangles, std::optional<std::uint64_t> rays,
                           double grid_ray_ns) {
    // Below two triangles log2 N has no meaning as a cost.
    const double log_n = std::log2(std::max(triangles, 2.0));

    HapalaDecision decision{};
    decision.tree_build_ns = constants.build_ns_per_n_log_n * triangles * log_n; // eq. 7
    decision.tree_ray_ns = constants.ray_ns_per_log_n * log_n;                   // eq. 8
    if (decision.tree_ray_ns >= grid_ray_ns) {                                   // step 5
        decision.critical_rays = std::numeric_limits<double>::infinity();
        decision.keep_grid = true;
        return decision;
    }
    decision.critical_rays = decision.tree_build_ns / (grid_ray_ns * (1.0 + epsilon) - decision.tree_ray_ns); // step 6
    decision.keep_grid = rays && static_cast<double>(*rays) <= decision.critical_rays; // step 7, put right
    return decision;
}

} // namespace raywise
