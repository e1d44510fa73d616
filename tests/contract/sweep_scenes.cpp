#include "contract/sweep_scenes.h"

#include "base/box.h"
#include "rays/rays.h"
#include "scenes/scenes.h"

#include <cmath>
#include <utility>

namespace raywise::sweep {
namespace {

bool is_float32(const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis) {
        if (static_cast<double>(static_cast<float>(v[axis])) != v[axis]) return false;
    }
    return true;
}

oracle::Scene converted(const workloads::Mesh& mesh, const std::string& name) {
    oracle::Scene scene{name, {}, {}};
    for (std::size_t i = 0; i + 2 < mesh.vertices.size(); i += 3) {
        scene.vertices.emplace_back(mesh.vertices[i], mesh.vertices[i + 1], mesh.vertices[i + 2]);
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        scene.triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
    }
    return scene;
}

} // namespace

SweepScene with_views(std::string family, oracle::Scene mesh) {
    SweepScene scene;
    scene.family = std::move(family);
    scene.mesh = std::move(mesh);
    scene.float32 = true;
    Box box;
    for (const Vec3& v : scene.mesh.vertices) {
        scene.float32 = scene.float32 && is_float32(v);
        box.extend(v);
    }
    if (!box.empty()) {
        scene.center = box.center();
        const Vec3 half = 0.5 * box.size();
        const double largest = max_component(half);
        // The squares of a denormal scene's size would vanish.
        if (largest > 0.0) scene.radius = largest * std::sqrt(glm::dot(half / largest, half / largest));
    }
    scene.eye = scene.center + scene.radius * Vec3(1.1, -1.9, 0.8);
    scene.light = scene.center + scene.radius * Vec3(-0.7, 0.4, 2.5);
    // Every other scene is lit along an axis, where projected boxes share their borders with the triangles.
    scene.sun = scene.mesh.name.size() % 2 == 0 ? Vec3(0.0, 0.0, -1.0) : Vec3(0.3, -0.2, -1.0);
    return scene;
}

std::vector<SweepScene> sweep_scenes(const SceneChoice& choice) {
    std::vector<SweepScene> scenes;
    if (choice.hard) {
        for (oracle::Scene& mesh : oracle::hard_scenes()) scenes.push_back(with_views("hard", std::move(mesh)));
    }
    if (choice.procedural) {
        constexpr std::uint64_t shape_seed = 1;
        for (const std::uint64_t size : choice.sizes) {
            for (const workloads::Scene& kind : workloads::scenes()) {
                const workloads::Mesh mesh = kind.make(size, shape_seed);
                SweepScene scene =
                    with_views("procedural", converted(mesh, std::string(kind.name) + " " + std::to_string(size)));
                if (mesh.camera) scene.eye = workloads::camera_of(mesh).eye;
                if (mesh.light) scene.light = workloads::light_of(mesh);
                scenes.push_back(std::move(scene));
            }
        }
    }
    if (choice.real) {
        for (oracle::Scene& mesh : oracle::real_meshes(choice.most_triangles))
            scenes.push_back(with_views("real", std::move(mesh)));
    }
    return scenes;
}

} // namespace raywise::sweep
