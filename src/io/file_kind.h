// From a path to the bytes behind it, and to the reader that knows them.
#pragma once

#include "io/file_mesh.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace raywise::io {

using FormatReader = FileMesh (*)(std::string_view bytes);

// Throws Error(ERROR_FILE_NOT_FOUND) where there is no file, and Error(ERROR_FILE_UNREADABLE) for a folder, a pipe or a device.
void require_plain_file(const std::filesystem::path& path);

// By the ending, in upper or lower case. Throws Error(ERROR_FILE_FORMAT) for any other.
FormatReader reader_of(const std::filesystem::path& path);

// The whole file. Throws Error(ERROR_FILE_UNREADABLE), and std::bad_alloc for one that does not fit in memory.
std::string read_file(const std::filesystem::path& path);

} // namespace raywise::io
