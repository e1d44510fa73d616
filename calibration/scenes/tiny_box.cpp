// The smallest scene worth a question: fixed costs are all there is.
#include "scenes/shapes.h"

namespace raywise::workloads {

Mesh make_tiny_box(std::uint64_t, std::uint64_t);

Mesh make_tiny_box(std::uint64_t, std::uint64_t) {
    Mesh mesh;
    add_box(mesh, {Vec3(-1.0, -0.7, -0.4), Vec3(1.0, 0.7, 0.4)});
    return mesh;
}

} // namespace raywise::workloads
