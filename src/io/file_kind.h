// From a path to the bytes behind it.
#pragma once

#include <filesystem>
#include <string>

namespace raywise::io {

enum class FileKind {
    obj,
    ply,
    off,
    stl
};

// By the ending, in upper or lower case. Throws Error(ERROR_FILE_FORMAT) for any other.
FileKind kind_of(const std::filesystem::path& path);

// The whole file. Throws Error(ERROR_FILE_NOT_FOUND) or Error(ERROR_FILE_UNREADABLE).
std::string read_file(const std::filesystem::path& path);

} // namespace raywise::io
