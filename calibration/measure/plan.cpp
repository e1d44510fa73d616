#include "measure/plan.h"

#include "scenes/scenes.h"

namespace raywise::calibration {
namespace {

constexpr double ms = 1e6; // nanoseconds

} // namespace

Plan quick_plan() {
    Plan plan;
    plan.mode = "quick";
    // Each shape of scene once or twice, sizes spread over three powers of ten.
    plan.meshes = {{"tiny_box", 12},        {"bumpy_sphere", 30'000}, {"soup", 1'000},   {"interior", 8'000},
                   {"terrain", 300},        {"stadium", 15'000},      {"sticks", 2'500}, {"sphereflake", 40'000},
                   {"bumpy_sphere", 1'500}, {"soup", 20'000}};
    plan.rays = 4'096;
    plan.ray_timing = {2.0 * ms, 3, 30.0 * ms};
    plan.most_call_ns = 3.0 * ms;
    plan.fewest_rays = 16;
    plan.build_timing = {1.0 * ms, 3, 60.0 * ms};
    plan.time_limit = 8.0;
    return plan;
}

Plan full_plan() {
    Plan plan;
    plan.mode = "full";
    plan.meshes = {{"tiny_box", 12}};
    for (const std::uint64_t triangles : {5'000u, 100u, 100'000u, 1'000u, 20'000u, 500'000u}) {
        for (const workloads::Scene& scene : workloads::scenes()) {
            if (std::string(scene.name) != "tiny_box") plan.meshes.push_back({scene.name, triangles});
        }
    }
    plan.rays = 32'768;
    plan.ray_timing = {10.0 * ms, 5, 500.0 * ms};
    plan.most_call_ns = 25.0 * ms;
    plan.fewest_rays = 32;
    plan.build_timing = {5.0 * ms, 5, 3000.0 * ms};
    plan.time_limit = 900.0;
    return plan;
}

} // namespace raywise::calibration
