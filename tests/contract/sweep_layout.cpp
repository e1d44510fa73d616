#include "contract/sweep_layout.h"

#include <cstdint>
#include <cstring>

namespace raywise::sweep {
namespace {

constexpr std::size_t padding = 5; // bytes; odd, so that alignment is lost at once

template <class Element>
void append(std::vector<std::byte>& bytes, const Element (&components)[3], bool padded) {
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof components + (padded ? padding : 0));
    std::memcpy(bytes.data() + at, components, sizeof components);
}

void append_vertex(std::vector<std::byte>& bytes, const Vec3& v, const MeshLayout& layout) {
    if (layout.float32) {
        const float components[3] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
        append(bytes, components, layout.padded);
    } else {
        const double components[3] = {v.x, v.y, v.z};
        append(bytes, components, layout.padded);
    }
}

void append_triangle(std::vector<std::byte>& bytes, const std::array<std::uint32_t, 3>& t, const MeshLayout& layout) {
    if (layout.wide_indices) {
        const std::uint64_t corners[3] = {t[0], t[1], t[2]};
        append(bytes, corners, layout.padded);
    } else {
        const std::uint32_t corners[3] = {t[0], t[1], t[2]};
        append(bytes, corners, layout.padded);
    }
}

rw_array described(const std::vector<std::byte>& bytes, std::int32_t type, std::size_t component, bool padded) {
    rw_array array{};
    array.data = bytes.data();
    array.type = type;
    array.stride = padded ? static_cast<std::int64_t>(3 * component + padding) : 0;
    return array;
}

} // namespace

LaidOutMesh::LaidOutMesh(const oracle::Scene& mesh, const MeshLayout& layout) {
    if (layout.unindexed) {
        for (const auto& triangle : mesh.triangles) {
            for (const std::uint32_t corner : triangle) append_vertex(vertices_, mesh.vertices[corner], layout);
        }
    } else {
        for (const Vec3& v : mesh.vertices) append_vertex(vertices_, v, layout);
        for (const auto& triangle : mesh.triangles) append_triangle(indices_, triangle, layout);
    }
    // An absent array stands for something else than an empty one.
    vertices_.reserve(1);
    indices_.reserve(1);
    triangles_.vertex_count = layout.unindexed ? 3 * mesh.triangles.size() : mesh.vertices.size();
    triangles_.triangle_count = mesh.triangles.size();
    triangles_.vertices = described(vertices_, layout.float32 ? RW_FLOAT32 : RW_FLOAT64,
                                    layout.float32 ? sizeof(float) : sizeof(double), layout.padded);
    if (!layout.unindexed) {
        triangles_.indices =
            described(indices_, layout.wide_indices ? RW_UINT64 : RW_UINT32,
                      layout.wide_indices ? sizeof(std::uint64_t) : sizeof(std::uint32_t), layout.padded);
    }
}

} // namespace raywise::sweep
