#include "bench/meshes.h"

#include <filesystem>
#include <stdexcept>

namespace raywise::bench {

namespace {

// Rounded: benchmarks hand every library the same float32 numbers.
std::vector<float> as_float32(const rw_array& array, std::uint64_t count) {
    std::vector<float> rounded(count);
    const auto* const doubles = static_cast<const double*>(array.data);
    const auto* const floats = static_cast<const float*>(array.data);
    for (std::uint64_t i = 0; i < count; ++i) {
        rounded[i] = array.type == RW_FLOAT64 ? static_cast<float>(doubles[i]) : floats[i];
    }
    return rounded;
}

} // namespace

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
    const auto* indices = static_cast<const std::uint32_t*>(triangles.indices.data);
    NamedMesh named{path.stem(), {}};
    named.mesh.vertices = as_float32(triangles.vertices, 3 * triangles.vertex_count);
    named.mesh.indices.assign(indices, indices + 3 * triangles.triangle_count);
    return {named};
}

} // namespace raywise::bench
