#include "base/files.h"

#include "base/descriptor.h"

#include <cerrno>
#include <new>

#include <fcntl.h>
#include <unistd.h>

namespace raywise {
namespace {

// What a small file needs beyond its size, and what is read at once of one that does not tell its size, as in /proc.
constexpr std::size_t spare_bytes = 4096;

} // namespace

ReadResult read_whole(const std::filesystem::path& path, std::string& content) {
    content.clear();
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.number() < 0 && errno == ENOMEM) throw std::bad_alloc();
    if (file.number() < 0) return ReadResult::not_opened;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    content.resize((error ? 0 : size) + spare_bytes);
    std::size_t used = 0;
    for (;;) {
        if (used == content.size()) content.resize(2 * used);
        const ssize_t count = ::read(file.number(), content.data() + used, content.size() - used);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0 && errno == ENOMEM) throw std::bad_alloc();
        if (count <= 0) {
            content.resize(used);
            return count == 0 ? ReadResult::complete : ReadResult::broken_off;
        }
        used += static_cast<std::size_t>(count);
    }
}

std::string content_or_nothing(const std::filesystem::path& path) {
    std::string content;
    if (read_whole(path, content) != ReadResult::complete) content.clear();
    return content;
}

} // namespace raywise
