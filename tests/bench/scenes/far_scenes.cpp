#include "bench/scenes/far_scenes.h"

#include "scenes/shapes.h"

#include <algorithm>
#include <cmath>

namespace raywise::bench {
namespace {

using workloads::add_triangle;
using workloads::add_vertex;
using workloads::Mesh;

constexpr double sun = 1.5e11;

double longest_side(const Mesh& mesh) {
    const Vec3 size = mesh.bounds().size();
    return std::max(size.x, std::max(size.y, size.z));
}

// Around the origin, so long, its coordinates multiples of `step`.
void fit(Mesh& mesh, double longest, double step) {
    const Vec3 centre = mesh.bounds().center();
    const double factor = longest / longest_side(mesh);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const double around = factor * (static_cast<double>(mesh.vertices[i]) - centre[static_cast<int>(i % 3)]);
        mesh.vertices[i] = static_cast<float>(step * std::round(around / step));
    }
}

} // namespace

TestScene far_ground(Mesh mesh, double times) {
    TestScene scene(mesh);
    const Box box = mesh.bounds();
    const Vec3 centre = box.center();
    const double half = 0.5 * times * longest_side(mesh);
    std::uint32_t corners[4];
    for (std::uint32_t i = 0; i < 4; ++i) {
        const double x = (i == 1 || i == 2) ? half : -half;
        corners[i] = add_vertex(scene.mesh, {centre.x + x, centre.y + (i < 2 ? -half : half), box.lower.z});
    }
    add_triangle(scene.mesh, corners[0], corners[1], corners[2]);
    add_triangle(scene.mesh, corners[0], corners[2], corners[3]);
    scene.aimed_at = std::move(mesh);
    return scene;
}

TestScene at_utm(Mesh terrain) {
    fit(terrain, 150.0, 0x1p-16);
    TestScene scene(terrain);
    scene.offset = Vec3(528980.25, 5183526.5, 112.125);
    add_triangle(scene.mesh, 0, 1, add_vertex(scene.mesh, -scene.offset));
    scene.aimed_at = std::move(terrain);
    return scene;
}

TestScene in_far_sun(Mesh mesh) {
    fit(mesh, 2.0, 0x1p-20);
    TestScene scene(std::move(mesh));
    scene.rays_from_height = sun;
    return scene;
}

} // namespace raywise::bench
