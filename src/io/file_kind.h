// From a path to the bytes behind it, and to the reader that knows them.
#pragma once

#include "io/file_mesh.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace raywise::io {

using FormatReader = FileMesh (*)(std::string_view bytes);

// By the ending, in upper or lower case. Throws Error(ERROR_FILE_FORMAT) for any other.
FormatReader reader_of(const std::filesystem::path& path);

// The whole file. Throws Error(ERROR_FILE_NOT_FOUND) or Error(ERROR_FILE_UNREADABLE).
std::string read_file(const std::filesystem::path& path);

} // namespace raywise::io
