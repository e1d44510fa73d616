#include "model/cost_functions.h"

#include "model/policy.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace raywise {
namespace {

// What costs grow with. Below two triangles log2 N would be zero or negative and a tree's ray would cost nothing.
struct Unit {
    const char* name;
    double (*of)(double triangles);
};

constexpr Unit linear{"N", [](double n) { return n; }};
constexpr Unit n_log_n{"N log2 N", [](double n) { return n * std::log2(std::max(n, 2.0)); }};
constexpr Unit log_n{"log2 N", [](double n) { return std::log2(std::max(n, 2.0)); }};
constexpr Unit cube_root{"N^(1/3)", [](double n) { return std::cbrt(n); }};

struct CostFunctions {
    Structure structure;
    Unit build;
    Unit ray;
    bool needs_view;
};

// One line per structure, in the order of structure_list.def.
constexpr CostFunctions table[] = {
    {Structure::linear_scan, linear, linear, false},
    // As many cells as triangles: a ray crosses the cube root of their number.
    {Structure::uniform_grid, linear, cube_root, false},
    {Structure::kd_tree, n_log_n, log_n, false},
    {Structure::bvh, n_log_n, log_n, false},
    {Structure::projected_bvh, n_log_n, log_n, true},
    {Structure::bvh_quality, n_log_n, log_n, false},
    // Radix sort: as many passes whatever the number.
    {Structure::bvh_morton, linear, log_n, false},
};

constexpr bool is_complete() {
    if (std::size(table) != structure_count) return false;
    for (std::size_t i = 0; i < structure_count; ++i) {
        if (table[i].structure != static_cast<Structure>(i)) return false;
    }
    return true;
}
static_assert(is_complete(), "one line per structure of structure_list.def, in its order");

const CostFunctions& functions_of(Structure structure) { return table[static_cast<std::size_t>(structure)]; }

} // namespace

double build_unit(Structure structure, double triangles) { return functions_of(structure).build.of(triangles); }
double ray_unit(Structure structure, double triangles) { return functions_of(structure).ray.of(triangles); }
const char* build_unit_name(Structure structure) { return functions_of(structure).build.name; }
const char* ray_unit_name(Structure structure) { return functions_of(structure).ray.name; }
bool needs_view(Structure structure) { return functions_of(structure).needs_view; }

Cost scan_in_place(const MachineConstants& constants, const Cost& gathered) {
    const StructureConstants& lines = constants.structures[Structure::linear_scan];
    Cost cost = gathered;
    cost.build_ns = lines.build_ns.fixed;
    cost.ray_ns += gathered.build_ns - lines.build_ns.fixed;
    cost.bytes = lines.bytes.fixed;
    return cost;
}

Cost predict(Structure structure, const MachineConstants& constants, const SceneFeatures& features,
             const Workload& workload) {
    const StructureConstants& lines = constants.structures[structure];
    const CostLine& ray_line = lines.ray_ns[ray_kind_index(workload.kind)];
    const double triangles = static_cast<double>(features.triangles);

    Cost cost;
    cost.build_ns = lines.build_ns.fixed + lines.build_ns.per_unit * build_unit(structure, triangles);
    cost.ray_ns = ray_line.fixed + ray_line.per_unit * ray_unit(structure, triangles);
    cost.bytes = lines.bytes.fixed + lines.bytes.per_unit * triangles;
    cost.error = std::max(lines.build_ns.residual, ray_line.residual);
    if (structure == Structure::linear_scan && !worth_gathering(workload)) return scan_in_place(constants, cost);
    return cost;
}

} // namespace raywise
