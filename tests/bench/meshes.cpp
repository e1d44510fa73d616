#include "bench/meshes.h"

#include <filesystem>
#include <stdexcept>

namespace raywise::bench {

NamedMesh procedural_mesh(const char* scene, std::uint64_t triangles) {
    constexpr std::uint64_t seed = 1;
    const workloads::Scene* const maker = workloads::scene_named(scene);
    if (maker == nullptr) throw std::runtime_error(std::string(scene) + ": no scene has that name");
    return {scene, maker->make(triangles, seed)};
}

std::vector<NamedMesh> mesh_file(const Library& library, const std::string& folder, const std::string& file) {
    const std::filesystem::path path = std::filesystem::path(folder) / file;
    std::error_code error;
    if (folder.empty() || !std::filesystem::is_regular_file(path, error)) return {};
    rw_mesh* mesh = nullptr;
    library.check(library.rw_mesh_load(path.c_str(), &mesh));
    const std::unique_ptr<rw_mesh, decltype(&::rw_mesh_release)> owner(mesh, library.rw_mesh_release);
    rw_triangles triangles{};
    triangles.struct_size = sizeof triangles;
    library.check(library.rw_mesh_triangles(mesh, &triangles));
    const auto* vertices = static_cast<const float*>(triangles.vertices.data);
    const auto* indices = static_cast<const std::uint32_t*>(triangles.indices.data);
    NamedMesh named{path.stem(), {}};
    named.mesh.vertices.assign(vertices, vertices + 3 * triangles.vertex_count);
    named.mesh.indices.assign(indices, indices + 3 * triangles.triangle_count);
    return {named};
}

} // namespace raywise::bench
