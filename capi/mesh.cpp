// Meshes from files.
#include "convert.h"
#include "guard.h"

using namespace raywise;
using namespace raywise::capi;

extern "C" {

std::int32_t rw_mesh_load(const char* path, rw_mesh** mesh) {
    return guard([&] {
        rw_mesh*& out = required(mesh, "mesh");
        out = new rw_mesh(std::make_shared<const LoadedMesh>(load_mesh(&required(path, "path"))));
    });
}

std::int32_t rw_mesh_retain(const rw_mesh* mesh) {
    return guard([&] { retain(mesh, "mesh"); });
}

std::int32_t rw_mesh_release(const rw_mesh* mesh) {
    return guard([&] { release(mesh); });
}

std::int32_t rw_mesh_triangles(const rw_mesh* mesh, rw_triangles* triangles) {
    return guard([&] {
        const LoadedMesh& m = *required(mesh, "mesh").value;
        rw_triangles description{};
        description.vertex_count = m.vertex_count();
        description.vertices.data =
            std::visit([](const auto& coordinates) -> const void* { return coordinates.data(); }, m.vertices);
        description.vertices.type = m.is_float64() ? RW_FLOAT64 : RW_FLOAT32;
        description.triangle_count = m.triangle_count();
        description.indices.data = m.indices.data();
        description.indices.type = RW_UINT32;
        write_struct(triangles, "triangles", description);
    });
}

std::int32_t rw_mesh_faces(const rw_mesh* mesh, const std::uint32_t** face_of_triangle, std::uint64_t* face_count) {
    return guard([&] {
        const LoadedMesh& m = *required(mesh, "mesh").value;
        required(face_of_triangle, "face_of_triangle") = m.face_of_triangle.data();
        if (face_count != nullptr) *face_count = m.face_count;
    });
}

} // extern "C"
