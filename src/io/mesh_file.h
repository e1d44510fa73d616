// Mesh files: OBJ, PLY, OFF and STL, as they stand in the file.
#pragma once

#include "base/vec.h"

#include <cstdint>
#include <filesystem>
#include <variant>
#include <vector>

namespace raywise {

struct LoadedMesh {
    // x, y, z of each vertex, in the order of the file: as float64 where float32 would change a coordinate of any.
    std::variant<std::vector<float>, std::vector<double>> vertices;
    std::vector<std::uint32_t> indices;          // three for each triangle
    std::vector<std::uint32_t> face_of_triangle; // the face of the file it was cut from
    std::uint32_t face_count = 0;                // faces in the file

    bool is_float64() const { return std::holds_alternative<std::vector<double>>(vertices); }
    std::size_t vertex_count() const {
        return std::visit([](const auto& coordinates) { return coordinates.size(); }, vertices) / 3;
    }
    Vec3 vertex(std::size_t i) const { return {coordinate(3 * i), coordinate(3 * i + 1), coordinate(3 * i + 2)}; }
    std::size_t triangle_count() const { return indices.size() / 3; }
    // What stands at `i` among the coordinates.
    double coordinate(std::size_t i) const {
        return std::visit([i](const auto& coordinates) { return static_cast<double>(coordinates[i]); }, vertices);
    }
};

// Reads a mesh file; its ending (.obj, .ply, .off, .stl, in upper or lower case) tells the format. Polygons are cut into
// triangles of their own corners (geometry/polygon_triangles.h). Vertices and faces come out as they are in the file: no
// vertex is moved or merged, no face is dropped or reordered, degenerate ones and meshes that are no manifolds included.
// docs/mesh-files.md tells what is read of each format.
//
// Throws Error: ERROR_FILE_NOT_FOUND, ERROR_FILE_UNREADABLE, ERROR_FILE_FORMAT, ERROR_NO_FACES, ERROR_BAD_POLYGON,
// ERROR_INDEX_OUT_OF_RANGE, ERROR_NOT_FINITE and ERROR_TOO_MANY. Any number of threads may load files at the same time.
LoadedMesh load_mesh(const std::filesystem::path& path);

} // namespace raywise
