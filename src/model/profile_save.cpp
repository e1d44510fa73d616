// Writing a profile so that a reader sees the old file or the new one and a failure leaves nothing behind.
#include "model/profile.h"

#include "base/format.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace raywise {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& problem) {
    throw Error(Status::ERROR_FILE_UNREADABLE, path.string() + ": cannot be written: " + problem);
}

// Makes the folders that are missing and, unless kept, removes those again.
class MadeFolders {
public:
    explicit MadeFolders(const fs::path& folder) {
        std::vector<fs::path> missing;
        std::error_code error;
        for (fs::path f = folder; !f.empty() && !fs::exists(f, error); f = f.parent_path()) missing.push_back(f);
        for (auto f = missing.rbegin(); f != missing.rend(); ++f) {
            if (::mkdir(f->c_str(), 0755) == 0) {
                made_.push_back(*f);
            } else if (errno != EEXIST) {
                const int reason = errno;
                remove();
                fail(*f, error_text(reason));
            }
        }
    }
    ~MadeFolders() { remove(); }
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;
    void keep() { made_.clear(); }

private:
    void remove() {
        for (auto f = made_.rbegin(); f != made_.rend(); ++f) ::rmdir(f->c_str());
        made_.clear();
    }
    std::vector<fs::path> made_;
};

// A new file beside the wanted one; gone again unless it was renamed.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& wanted) : wanted_(wanted), name_(wanted.string() + ".XXXXXX") {
        descriptor_ = ::mkstemp(name_.data());
        if (descriptor_ < 0) fail(wanted_, error_text(errno));
    }
    ~TemporaryFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!renamed_) ::unlink(name_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    void write(const std::string& text) {
        for (std::size_t done = 0; done < text.size();) {
            const ssize_t count = ::write(descriptor_, text.data() + done, text.size() - done);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) fail(wanted_, error_text(errno));
            done += static_cast<std::size_t>(count);
        }
        // Readable for all; on the disk before the name points to it.
        if (::fchmod(descriptor_, 0644) != 0 || ::fsync(descriptor_) != 0) fail(wanted_, error_text(errno));
        const int closed = ::close(descriptor_);
        descriptor_ = -1;
        if (closed != 0) fail(wanted_, error_text(errno));
    }
    void rename() {
        if (::rename(name_.c_str(), wanted_.c_str()) != 0) fail(wanted_, error_text(errno));
        renamed_ = true;
    }

private:
    fs::path wanted_;
    std::string name_;
    int descriptor_ = -1;
    bool renamed_ = false;
};

// The new name is on the disk as well. A file system that cannot do this has done what it can.
void sync_folder(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    static_cast<void>(::fsync(descriptor));
    ::close(descriptor);
}

// The file behind a symbolic link, so that the link stays one; absolute.
fs::path resolved(const fs::path& path) {
    std::error_code error;
    const fs::path target = fs::weakly_canonical(path, error);
    if (error) fail(path, error_text(error.value()));
    return target;
}

} // namespace

void save_profile(const Profile& profile, const fs::path& path) {
    const std::string text = to_json(profile);
    static_cast<void>(parse_profile(text)); // what could not be read back is not worth writing

    if (path.empty()) fail(path, "the path is empty");
    const fs::path wanted = resolved(path);
    std::error_code error;
    const fs::file_status there = fs::status(wanted, error);
    // A rename would put a plain file in the place of a folder or a device.
    if (fs::exists(there) && !fs::is_regular_file(there)) fail(wanted, "it is there and not a plain file");

    MadeFolders folders(wanted.parent_path());
    TemporaryFile file(wanted);
    file.write(text);
    file.rename();
    folders.keep();
    sync_folder(wanted.parent_path());
}

} // namespace raywise
