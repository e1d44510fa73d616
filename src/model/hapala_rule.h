// The published rule: keep the grid, or build a kd-tree. Hapala, Karlik, Havran, "When It Makes Sense to Use Uniform
// Grids for Ray Tracing", 2011, section 3. Step 7 of the paper's listing has its comparison the wrong way round; its
// discussion, which is followed here, keeps the grid while R <= R_C.
#pragma once

#include "model/constants.h"

#include <cstdint>
#include <optional>

namespace raywise {

struct HapalaDecision {
    bool keep_grid;
    double tree_build_ns; // eq. 7
    double tree_ray_ns;   // eq. 8
    double critical_rays; // R_C; infinite when the grid's rays are the cheaper ones
};

// triangles: N. rays: R; empty: unknown, counted as infinitely many. grid_ray_ns: measured on a sample of rays on the
// built grid.
HapalaDecision hapala_rule(const HapalaConstants& constants, double triangles, std::optional<std::uint64_t> rays,
                           double grid_ray_ns);

} // namespace raywise
