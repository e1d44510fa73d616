// A room: six walls of two triangles each, boxes on the floor, finely tessellated balls on the boxes and under the
// ceiling.
#include "scenes/random.h"
#include "scenes/shapes.h"

#include <algorithm>

namespace raywise::workloads {

Mesh make_interior(std::uint64_t triangles, std::uint64_t seed);

Mesh make_interior(std::uint64_t triangles, std::uint64_t seed) {
    Random random(seed);
    const Vec3 room(8.0, 6.0, 3.0);
    Mesh mesh;
    add_box(mesh, {Vec3(0.0), room}, true);

    // A quarter of the triangles are boxes.
    const std::uint64_t boxes = std::clamp<std::uint64_t>(triangles / 48, 1, 5000);
    std::vector<Vec3> tops;
    for (std::uint64_t i = 0; i < boxes; ++i) {
        // In braces, because the order of arguments in parentheses is the compiler's to choose.
        const Vec3 size{random.uniform(0.02, 0.5), random.uniform(0.02, 0.5), random.uniform(0.02, 0.9)};
        const Vec3 corner{random.uniform(0.5, room.x - 1.0), random.uniform(0.5, room.y - 1.0), 0.0};
        add_box(mesh, {corner, corner + size});
        tops.push_back(corner + Vec3(size.x / 2.0, size.y / 2.0, size.z));
    }
    const std::uint64_t left = triangles > mesh.triangle_count() ? triangles - mesh.triangle_count() : 0;
    const std::uint64_t balls = std::clamp<std::uint64_t>(left / 200, 1, 2000);
    for (std::uint64_t i = 0; i < balls; ++i) {
        const double radius = random.uniform(0.03, 0.15);
        const Vec3 place =
            i % 4 == 0 ? Vec3{random.uniform(0.5, room.x - 0.5), random.uniform(0.5, room.y - 0.5), room.z - 0.4}
                       : tops[random.bits() % tops.size()] + Vec3(0.0, 0.0, radius);
        const std::uint64_t remaining = triangles > mesh.triangle_count() ? triangles - mesh.triangle_count() : 0;
        add_sphere(mesh, place, radius, remaining / (balls - i));
    }
    mesh.camera = Camera{Vec3(0.3, 0.3, 1.7), Vec3(5.0, 4.0, 0.7), 1.0};
    mesh.light = Vec3(room.x / 2.0, room.y / 2.0, room.z - 0.1);
    return mesh;
}

} // namespace raywise::workloads
