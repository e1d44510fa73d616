#include "io/file_kind.h"

#include "base/error.h"
#include "base/files.h"
#include "base/format.h"

#include <system_error>

namespace raywise::io {

FileKind kind_of(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    for (char& c : ending) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    if (ending == ".obj") return FileKind::obj;
    if (ending == ".ply") return FileKind::ply;
    if (ending == ".off") return FileKind::off;
    if (ending == ".stl") return FileKind::stl;
    throw Error(Status::ERROR_FILE_FORMAT, "the ending \"" + ending + "\" is none of .obj, .ply, .off and .stl");
}

std::string read_file(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) throw Error(Status::ERROR_FILE_NOT_FOUND, "there is no such file");
    if (error) throw Error(Status::ERROR_FILE_UNREADABLE, "cannot be looked at: " + error_text(error.value()));
    // Opening a pipe could wait for ever.
    if (!fs::is_regular_file(status)) throw Error(Status::ERROR_FILE_UNREADABLE, "is no plain file");
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
