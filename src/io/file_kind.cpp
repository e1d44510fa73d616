#include "io/file_kind.h"

#include "base/error.h"
#include "base/files.h"
#include "base/format.h"
#include "io/text_source.h"

#include <system_error>

namespace raywise::io {

namespace {

constexpr struct {
    const char* ending;
    FormatReader read;
} formats[] = {{".obj", read_obj}, {".ply", read_ply}, {".off", read_off}, {".stl", read_stl}};

} // namespace

void require_plain_file(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) throw Error(Status::ERROR_FILE_NOT_FOUND, "there is no such file");
    if (error) throw Error(Status::ERROR_FILE_UNREADABLE, "cannot be looked at: " + error_text(error.value()));
    // Opening a pipe could wait for ever.
    if (!fs::is_regular_file(status)) throw Error(Status::ERROR_FILE_UNREADABLE, "is no plain file");
}

FormatReader reader_of(const std::filesystem::path& path) {
    const std::string ending = path.extension().string();
    for (const auto& format : formats) {
        if (is_word(ending, format.ending)) return format.read;
    }
    throw Error(Status::ERROR_FILE_FORMAT,
                "the ending " + io::quoted(ending) + " is none of .obj, .ply, .off and .stl");
}

std::string read_file(const std::filesystem::path& path) {
    std::string bytes;
    switch (read_whole(path, bytes)) {
        case ReadResult::complete:
            break;
        case ReadResult::not_opened:
            throw Error(Status::ERROR_FILE_UNREADABLE, "cannot be opened");
        case ReadResult::broken_off:
            throw Error(Status::ERROR_FILE_UNREADABLE, "cannot be read to its end");
    }
    return bytes;
}

} // namespace raywise::io
