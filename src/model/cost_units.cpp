#include "model/cost_units.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace raywise {
namespace {

constexpr CostUnit n{"N", [](const SceneFeatures& scene) { return scene.triangles; }};
// Below two triangles log2 N would be zero or negative and a tree's ray would cost nothing.
constexpr CostUnit log_n{"log2 N",
                         [](const SceneFeatures& scene) { return std::log2(std::max(scene.triangles, 2.0)); }};
constexpr CostUnit n_log_n{
    "N log2 N", [](const SceneFeatures& scene) { return scene.triangles * std::log2(std::max(scene.triangles, 2.0)); }};
constexpr CostUnit references{"references",
                              [](const SceneFeatures& scene) { return scene.triangles * scene.references; }};
constexpr CostUnit boxes{"boxes", [](const SceneFeatures& scene) { return scene.boxes; }};
constexpr CostUnit cells{"cells", [](const SceneFeatures& scene) { return scene.cells; }};
constexpr CostUnit filled{"filled", [](const SceneFeatures& scene) { return scene.filled; }};
constexpr CostUnit crowding{"crowding", [](const SceneFeatures& scene) { return scene.crowding; }};
// What outgrows the second-level cache of today's machines: levels of a tree that are fetched from farther away.
constexpr CostUnit levels_beyond{"far levels", [](const SceneFeatures& scene) {
                                     return std::max(0.0, std::log2(std::max(scene.triangles, 1.0) / 32768.0));
                                 }};

// Which of the quantities tell costs of rays best was looked for over scenes of calibration/scenes from 100 to 500,000 triangles and scanned
// meshes; docs/decisions/0028-features.md.
constexpr CostUnits tree_ray{log_n, filled, boxes, levels_beyond};
constexpr CostUnits grid_ray{cells, filled, crowding};

struct UnitsOfStructure {
    Structure structure;
    CostUnits build;
    CostUnits ray;
    CostUnits bytes;
    bool needs_view;
    bool differs_by_rays;
    Spared spared;
};

// In the order of structure_list.def.
constexpr UnitsOfStructure table[] = {
    {Structure::linear_scan, CostUnits(n), CostUnits(n), CostUnits(n), false, false, Spared::blocks},
    {Structure::uniform_grid, CostUnits(n, references), grid_ray, CostUnits(n, references), false, true, Spared::cells},
    {Structure::kd_tree, CostUnits(n_log_n, references), tree_ray, CostUnits(n, references), false, false,
     Spared::nothing},
    {Structure::bvh, CostUnits(n, n_log_n), tree_ray, CostUnits(n), false, false, Spared::nothing},
    {Structure::projected_bvh, CostUnits(n, n_log_n), tree_ray, CostUnits(n), true, false, Spared::nothing},
    {Structure::bvh_quality, CostUnits(n, n_log_n), tree_ray, CostUnits(n), false, false, Spared::nothing},
    // Radix sort: as many passes whatever the number.
    {Structure::bvh_morton, CostUnits(n), tree_ray, CostUnits(n), false, false, Spared::nothing},
    {Structure::two_level_grid, CostUnits(n, references), CostUnits(log_n, cells, filled, boxes),
     CostUnits(n, references), false, true, Spared::cells},
};

constexpr bool is_complete() {
    if (std::size(table) != structure_count) return false;
    for (std::size_t i = 0; i < structure_count; ++i) {
        if (table[i].structure != static_cast<Structure>(i)) return false;
    }
    return true;
}
static_assert(is_complete(), "one line per structure of structure_list.def, in its order");

const UnitsOfStructure& units_of(Structure structure) { return table[static_cast<std::size_t>(structure)]; }

} // namespace

const CostUnits& build_units(Structure structure) { return units_of(structure).build; }
const CostUnits& ray_units(Structure structure) { return units_of(structure).ray; }
const CostUnits& byte_units(Structure structure) { return units_of(structure).bytes; }
bool needs_view(Structure structure) { return units_of(structure).needs_view; }
bool differs_by_rays(Structure structure) { return units_of(structure).differs_by_rays; }
Spared spared(Structure structure) { return units_of(structure).spared; }

} // namespace raywise
