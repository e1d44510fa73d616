// OpenMesh's readers, without its meshes: vertices and faces as the reader comes across them.
#pragma once

#include "io/file_kind.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace raywise::io {

struct RawMesh {
    std::vector<float> vertices;          // x, y, z
    std::vector<std::int64_t> corners;    // of all faces
    std::vector<std::size_t> face_ends{}; // where in `corners` each face ends

    std::size_t face_count() const { return face_ends.size(); }
};

// Runs the reader of that kind over a text that has been prepared for it (see expected.h). Throws
// Error(ERROR_FILE_FORMAT) when it refuses. One text at a time: the readers keep their state in globals.
RawMesh read_with_openmesh(FileKind kind, const std::filesystem::path& path, const std::string& text);

} // namespace raywise::io
