// Reading whole files. A stream that is refused memory looks like one whose file is missing or at its end; these throw
// std::bad_alloc.
#pragma once

#include <filesystem>
#include <string>

namespace raywise {

enum class ReadResult {
    complete,
    not_opened,
    broken_off
};

// The whole file as far as it could be read.
ReadResult read_whole(const std::filesystem::path& path, std::string& content);

// The same of a file that need not be there: empty then.
std::string content_or_nothing(const std::filesystem::path& path);

} // namespace raywise
