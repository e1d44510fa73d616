#include "measure/exact_test.h"

#include "base/structure.h"

#include <cstdint>

namespace raywise::calibration {
namespace {

constexpr std::uint32_t copies = 4096;
constexpr std::uint64_t ray_count = 64;

workloads::Mesh copies_of_one_triangle() {
    workloads::Mesh mesh;
    mesh.vertices = {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f};
    for (std::uint32_t i = 0; i < copies; ++i) mesh.indices.insert(mesh.indices.end(), {0, 1, 2});
    return mesh;
}

// Outside the longest edge by 2^-22 to 2^-23: float32 knows an edge's value of this triangle to about 2^-19, float64 to 2^-43.
workloads::Rays rays_beside_the_edge() {
    workloads::Rays rays;
    for (std::uint64_t i = 0; i < ray_count; ++i) {
        const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(ray_count);
        rays.add({x, (1.0 - x) + 0x1p-22, -1.0}, {0.0, 0.0, 1.0}, 0.0, 2.0);
    }
    return rays;
}

} // namespace

Timing measure_exact_test(const rw_profile* profile, const TimingLimits& limits, Clock clock) {
    const workloads::Mesh mesh = copies_of_one_triangle();
    const workloads::Rays rays = rays_beside_the_edge();
    BuiltScene scene(mesh, name_of(Structure::linear_scan), profile, 1);
    const RaySelection all{rays, rays.size()};
    Timing timing = time_in_turns({with_clock([&] { scene.ask(all, false, 1); }, clock)}, limits).front();
    timing.ns /= static_cast<double>(copies) * static_cast<double>(ray_count);
    return timing;
}

} // namespace raywise::calibration
