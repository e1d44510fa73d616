// Reading a profile's file, which may be anything: missing, a folder, a pipe without a writer, a device without an end.
#include "base/descriptor.h"
#include "base/format.h"
#include "model/profile.h"

#include <cerrno>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace raywise {
namespace {

// A profile takes some ten thousand bytes.
constexpr std::size_t most_bytes = std::size_t{1} << 20;

[[noreturn]] void fail(Status status, const std::string& problem) { throw Error(status, problem); }

[[noreturn]] void fail_with_errno(int error) {
    if (error == ENOENT || error == ENOTDIR) fail(Status::PROFILE_NOT_FOUND, "there is no such file");
    fail(Status::PROFILE_UNREADABLE, "cannot be read: " + error_text(error));
}

void demand_plain_file(const struct stat& facts) {
    if (!S_ISREG(facts.st_mode)) fail(Status::PROFILE_UNREADABLE, "is not a plain file");
    if (facts.st_size > static_cast<off_t>(most_bytes)) {
        fail(Status::PROFILE_UNREADABLE, "is over 1 MiB: " + std::to_string(facts.st_size) + " bytes");
    }
}

std::string read_text(const std::string& path) {
    // Looked at before it is opened, because opening alone can block on a pipe or move a device; and once more
    // afterwards, because it may have been exchanged in between.
    struct stat facts {};
    if (::stat(path.c_str(), &facts) != 0) fail_with_errno(errno);
    demand_plain_file(facts);
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
    if (file.number() < 0) fail_with_errno(errno);
    if (::fstat(file.number(), &facts) != 0) fail_with_errno(errno);
    demand_plain_file(facts);

    std::string text;
    char block[16384];
    for (;;) {
        const ssize_t count = ::read(file.number(), block, sizeof(block));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail_with_errno(errno);
        if (count == 0) return text;
        text.append(block, static_cast<std::size_t>(count));
        if (text.size() > most_bytes) fail(Status::PROFILE_UNREADABLE, "is over 1 MiB");
    }
}

} // namespace

Profile read_profile(const std::filesystem::path& path) {
    const std::string name = path.string();
    try {
        Profile profile = parse_profile(read_text(name));
        profile.source = ProfileSource::path;
        profile.path = name;
        return profile;
    } catch (const Error& error) {
        throw Error(error.status(), name + ": " + error.what());
    }
}

} // namespace raywise
