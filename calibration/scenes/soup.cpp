// Triangles without neighbours, order or surface. Their size follows their density, so that a ray meets as many gaps at
// any number.
#include "scenes/random.h"
#include "scenes/shapes.h"

#include <algorithm>
#include <cmath>

namespace raywise::workloads {

Mesh make_soup(std::uint64_t triangles, std::uint64_t seed);

Mesh make_soup(std::uint64_t triangles, std::uint64_t seed) {
    triangles = std::max<std::uint64_t>(triangles, 1);
    Random random(seed);
    // Half the mean distance of neighbours. Rounded to float32, because platforms differ in the last bit of cbrt.
    const double size = 0.5 * static_cast<double>(static_cast<float>(std::cbrt(1.0 / static_cast<double>(triangles))));
    Mesh mesh;
    for (std::uint64_t i = 0; i < triangles; ++i) {
        const Vec3 centre = random.in_cube();
        std::uint32_t corner[3];
        for (std::uint32_t& c : corner) c = add_vertex(mesh, centre + random.on_sphere() * size);
        add_triangle(mesh, corner[0], corner[1], corner[2]);
    }
    return mesh;
}

} // namespace raywise::workloads
