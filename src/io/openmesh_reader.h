// OpenMesh's reader, without its meshes: vertices and faces as the reader comes across them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::io {

struct RawMesh {
    std::vector<float> vertices;        // x, y, z: OpenMesh's readers deliver float32, whatever the file holds
    std::vector<std::uint32_t> corners; // of all faces
    std::vector<std::size_t> face_ends; // where in `corners` each face ends

    std::size_t face_count() const { return face_ends.size(); }
};

// Runs OpenMesh's PLY reader over the text of a file. Throws Error(ERROR_FILE_FORMAT) when it refuses. One text at a time: the
// reader keeps its state in globals.
RawMesh read_with_openmesh(std::string ply);

} // namespace raywise::io
