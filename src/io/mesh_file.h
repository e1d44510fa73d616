// Mesh files: OBJ, PLY, OFF and STL, as they stand in the file.
#pragma once

#include "base/vec.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace raywise {

struct LoadedMesh {
    std::vector<float> vertices;                 // x, y, z of each vertex, in the order of the file
    std::vector<std::uint32_t> indices;          // three for each triangle
    std::vector<std::uint32_t> face_of_triangle; // the face of the file it was cut from
    std::uint32_t face_count = 0;                // faces in the file

    std::size_t vertex_count() const { return vertices.size() / 3; }
    Vec3 vertex(std::size_t i) const { return {vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]}; }
    std::size_t triangle_count() const { return indices.size() / 3; }
};

// Reads a mesh file; its ending (.obj, .ply, .off, .stl, in upper or lower case) tells the format. Polygons are cut into
// triangles of their own corners (geometry/polygon_triangles.h). Vertices and faces come out as they are in the file: no
// vertex is merged, no face is dropped or reordered, degenerate ones and meshes that are no manifolds included.
//
// Throws Error: ERROR_FILE_NOT_FOUND, ERROR_FILE_UNREADABLE, ERROR_FILE_FORMAT, ERROR_NO_FACES, ERROR_BAD_POLYGON,
// ERROR_INDEX_OUT_OF_RANGE, ERROR_NOT_FINITE and ERROR_TOO_MANY. Any number of threads may load files at the same time.
LoadedMesh load_mesh(const std::filesystem::path& path);

} // namespace raywise
