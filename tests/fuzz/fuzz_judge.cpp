// Few triangles and rays before the exact judge of tests/oracle: which triangles are hit, how accurate t, u and v are, and in
// which order. The other fuzzers compare structures with the linear scan; this one looks at the linear scan itself.
#include "fuzz/failure.h"
#include "fuzz/input.h"
#include "fuzz/meshes.h"
#include "fuzz/rays.h"
#include "oracle/compare.h"
#include "oracle/judge.h"

#include <algorithm>
#include <cmath>

namespace raywise::fuzz {
namespace {

// Fractions of thousands of digits take their time.
constexpr std::size_t most_triangles = 16;

oracle::Scene scene_of(const Mesh& mesh) {
    oracle::Scene scene;
    scene.name = "scene";
    for (const Point& p : mesh.vertices()) {
        Vec3 v(p[0], p[1], p[2]);
        // No triangle that is taken below has this vertex; the judge wants a number all the same.
        if (!is_finite(v)) v = Vec3(0.0);
        scene.vertices.push_back(v);
    }
    for (std::uint64_t i = 0; i < mesh.triangle_count() && scene.triangles.size() < most_triangles; ++i) {
        if (mesh.is_invalid(i)) continue;
        const auto& corners = mesh.corners()[i];
        scene.triangles.push_back({static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[1]),
                                   static_cast<std::uint32_t>(corners[2])});
    }
    for (Vec3& v : scene.vertices) { // beyond what a mesh may have, and in none of these triangles either
        for (int axis = 0; axis < 3; ++axis) {
            if (std::fabs(v[axis]) > static_cast<double>(std::numeric_limits<float>::max())) v = Vec3(0.0);
        }
    }
    return scene;
}

bool has_area(const oracle::Scene& scene) {
    return std::any_of(scene.triangles.begin(), scene.triangles.end(), [&](const auto& t) {
        return !oracle::has_no_area(scene.vertices[t[0]], scene.vertices[t[1]], scene.vertices[t[2]]);
    });
}

// The ray as the library's contract reads it: components of the direction below 2^-500 of the largest are zero. False for rays
// that cannot hit anything, and for those whose t may be too large to be told.
bool take(const rw_ray& source, Ray& ray) {
    ray.origin = {source.origin[0], source.origin[1], source.origin[2]};
    ray.direction = {source.direction[0], source.direction[1], source.direction[2]};
    ray.tmin = source.tmin;
    ray.tmax = source.tmax;
    if (!ray.is_traceable()) return false;
    const double largest = max_component(glm::abs(ray.direction));
    if (largest < 0x1p-600) return false;
    if (max_component(glm::abs(ray.origin)) > 0x1p200) return false;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::fabs(std::ldexp(ray.direction[axis], -std::ilogb(largest))) < ExactRay::smallest_direction) {
            ray.direction[axis] = 0.0;
        }
    }
    return true;
}

} // namespace
} // namespace raywise::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace raywise;
    using namespace raywise::fuzz;
    Input input(data, size);
    const auto mesh = std::make_shared<Mesh>(input);
    if (mesh->outcome().must_fail()) return 0;
    const oracle::Scene scene = scene_of(*mesh);
    if (!has_area(scene)) return 0; // nothing to hit, and no measure for the errors
    std::vector<Ray> rays;
    for (int i = 0; i < 8 && !input.is_empty(); ++i) {
        Ray ray;
        if (take(make_ray(input, {mesh}), ray)) rays.push_back(ray);
    }
    const oracle::Comparison comparison = oracle::compare_with_judge(scene, rays);
    if (!comparison.faults.empty()) fail("%s", comparison.text().c_str());
    return 0;
}
