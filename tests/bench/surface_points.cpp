#include "bench/surface_points.h"

#include <cmath>

namespace raywise::bench {

std::vector<workloads::SurfacePoint> surface_points(const workloads::Mesh& mesh, const Built& built,
                                                    const workloads::Rays& rays, unsigned threads) {
    const RaySet asked = rounded(rays);
    Answers answers;
    QueryRequest request{asked};
    request.call = Call::batch;
    request.threads = threads;
    request.answers = &answers;
    built.query(request)->ask(0, asked.size());
    std::vector<workloads::SurfacePoint> points(asked.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].t = static_cast<double>(answers.t[i]);
        if (std::isinf(points[i].t)) continue;
        const auto corner = [&](std::size_t k) {
            const std::size_t vertex = 3 * std::size_t{mesh.indices[3 * std::size_t{answers.primitive[i]} + k]};
            return Vec3(mesh.vertices[vertex], mesh.vertices[vertex + 1], mesh.vertices[vertex + 2]);
        };
        points[i].normal = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    }
    return points;
}

} // namespace raywise::bench
