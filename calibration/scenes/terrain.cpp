// A height field of fractal noise.
#include "scenes/shapes.h"

#include <algorithm>
#include <cmath>

namespace raywise::workloads {

Mesh make_terrain(std::uint64_t triangles, std::uint64_t seed);

Mesh make_terrain(std::uint64_t triangles, std::uint64_t seed) {
    const double quads = std::max(1.0, static_cast<double>(triangles) / 2.0);
    const auto columns = static_cast<std::uint32_t>(std::max(1.0, std::floor(std::sqrt(quads))));
    const auto rows = static_cast<std::uint32_t>(std::max(1.0, std::floor(quads / columns)));
    Mesh mesh;
    for (std::uint32_t j = 0; j <= rows; ++j) {
        for (std::uint32_t i = 0; i <= columns; ++i) {
            const double x = 4.0 * i / columns - 2.0, y = 4.0 * j / rows - 2.0;
            const double height = fractal_noise(Vec3(x * 1.5 + 100.0, y * 1.5 + 100.0, 0.5), 8, seed);
            add_vertex(mesh, {x, y, 1.5 * height});
        }
    }
    const std::uint32_t stride = columns + 1;
    for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t a = j * stride + i;
            add_triangle(mesh, a, a + 1, a + stride + 1);
            add_triangle(mesh, a, a + stride + 1, a + stride);
        }
    }
    return mesh;
}

} // namespace raywise::workloads
