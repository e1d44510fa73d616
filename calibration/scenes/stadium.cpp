// The "teapot in a stadium": a detailed object that fills a ten-millionth of the hall around it.
#include "scenes/shapes.h"

namespace raywise::workloads {

Mesh make_stadium(std::uint64_t triangles, std::uint64_t seed);

Mesh make_stadium(std::uint64_t triangles, std::uint64_t seed) {
    constexpr double hall = 200.0; // half its width; the object's radius is about 1
    Mesh mesh;
    add_box(mesh, {Vec3(-hall, -hall, -1.2), Vec3(hall, hall, hall)}, true);
    add_ball(mesh, Vec3(0.0), triangles > 20 ? triangles - 12 : 8,
             [&](const Vec3& direction) { return 0.7 + 0.6 * fractal_noise(direction * 2.0 + 50.0, 6, seed); });
    mesh.camera = Camera{Vec3(4.0, -5.0, 2.5), Vec3(0.0), 0.6};
    mesh.light = Vec3(30.0, -20.0, 60.0);
    return mesh;
}

} // namespace raywise::workloads
