#include "bench/scenes/shapes.h"

#include "scenes/random.h"
#include "scenes/shapes.h"

namespace raywise::bench {

using workloads::add_triangle;
using workloads::add_vertex;
using workloads::Mesh;

Mesh in_a_hall(Mesh mesh, double times) {
    const Box box = mesh.bounds();
    const Vec3 size = box.size();
    const Vec3 centre = box.center();
    const double half = 0.5 * times * std::max(size.x, std::max(size.y, size.z));
    const double ground = box.lower.z;
    workloads::add_box(mesh,
                       {Vec3(centre.x - half, centre.y - half, ground - 0.01 * size.z),
                        Vec3(centre.x + half, centre.y + half, ground + half)},
                       true);
    constexpr std::uint32_t tiles = 100;
    std::uint32_t first = 0;
    for (std::uint32_t j = 0; j <= tiles; ++j) {
        for (std::uint32_t i = 0; i <= tiles; ++i) {
            const double x = 2.0 * i / tiles - 1.0, y = 2.0 * j / tiles - 1.0;
            const std::uint32_t vertex = add_vertex(mesh, {centre.x + half * x, centre.y + half * y, ground});
            if (i == 0 && j == 0) first = vertex;
        }
    }
    for (std::uint32_t j = 0; j < tiles; ++j) {
        for (std::uint32_t i = 0; i < tiles; ++i) {
            const std::uint32_t a = first + j * (tiles + 1) + i;
            add_triangle(mesh, a, a + 1, a + tiles + 2);
            add_triangle(mesh, a, a + tiles + 2, a + tiles + 1);
        }
    }
    const double length = std::max(size.x, std::max(size.y, size.z));
    mesh.camera = workloads::Camera{centre + Vec3(1.1, -1.6, 0.9) * length, centre, 0.7};
    mesh.light = centre + Vec3(30.0, -20.0, 60.0) * length;
    return mesh;
}

Mesh long_sticks(std::uint64_t triangles) {
    constexpr double half_length = 0.1;
    constexpr double width = half_length / 500.0;
    workloads::Random random(1);
    Mesh mesh;
    for (std::uint64_t i = 0; i < triangles; ++i) {
        const Vec3 middle = random.in_cube();
        const Vec3 along = random.on_sphere();
        const Vec3 across = workloads::Frame(along).x;
        const std::uint32_t a = add_vertex(mesh, middle - along * half_length);
        const std::uint32_t b = add_vertex(mesh, middle + along * half_length);
        const std::uint32_t c = add_vertex(mesh, middle + along * half_length + across * width);
        add_triangle(mesh, a, b, c);
    }
    return mesh;
}

} // namespace raywise::bench
