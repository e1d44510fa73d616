// Long thin triangles in all directions: bounding boxes that are almost empty and overlap everywhere. Above 64,000 they
// get shorter as they get more, so that a box overlaps dozens of others and not ever more of them.
#include "scenes/random.h"
#include "scenes/shapes.h"

#include <algorithm>
#include <cmath>

namespace raywise::workloads {

Mesh make_sticks(std::uint64_t triangles, std::uint64_t seed);

Mesh make_sticks(std::uint64_t triangles, std::uint64_t seed) {
    triangles = std::max<std::uint64_t>(triangles, 1);
    Random random(seed);
    // Of a cube of size 1; twice the mean distance of neighbours at most. Rounded to float32, because platforms differ
    // in the last bit of cbrt.
    const double neighbour = static_cast<double>(static_cast<float>(std::cbrt(1.0 / static_cast<double>(triangles))));
    const double half_length = std::min(0.05, 2.0 * neighbour);
    const double width = half_length / 50.0;
    Mesh mesh;
    for (std::uint64_t i = 0; i < triangles; ++i) {
        const Vec3 middle = random.in_cube();
        const Vec3 along = random.on_sphere();
        const Vec3 across = Frame(along).x;
        const std::uint32_t a = add_vertex(mesh, middle - along * half_length);
        const std::uint32_t b = add_vertex(mesh, middle + along * half_length);
        const std::uint32_t c = add_vertex(mesh, middle + along * half_length + across * width);
        add_triangle(mesh, a, b, c);
    }
    return mesh;
}

} // namespace raywise::workloads
