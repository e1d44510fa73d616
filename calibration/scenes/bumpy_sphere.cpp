// A closed surface with detail at several scales, as scanners deliver them.
#include "scenes/shapes.h"

namespace raywise::workloads {

Mesh make_bumpy_sphere(std::uint64_t triangles, std::uint64_t seed);

Mesh make_bumpy_sphere(std::uint64_t triangles, std::uint64_t seed) {
    Mesh mesh;
    add_ball(mesh, Vec3(0.0), triangles,
             [&](const Vec3& direction) { return 0.6 + 0.8 * fractal_noise(direction * 1.5 + 20.0, 7, seed); });
    return mesh;
}

} // namespace raywise::workloads
