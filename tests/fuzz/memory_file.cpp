#include "fuzz/memory_file.h"

#include "fuzz/failure.h"

#include <cstdlib>
#include <filesystem>

#include <sys/mman.h>
#include <unistd.h>

namespace raywise::fuzz {

MemoryFile::MemoryFile(const std::vector<std::string>& endings)
    : descriptor_(memfd_create("raywise-fuzz", MFD_CLOEXEC)), endings_(endings) {
    demand(descriptor_ >= 0, "there is no memory for a file");
    // By the process's number: libFuzzer's own children would otherwise see files of their own under /proc/self.
    path_ = "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(descriptor_);
    if (endings_.empty()) return;
    folder_ = (std::filesystem::temp_directory_path() / "raywise-fuzz-XXXXXX").string();
    demand(mkdtemp(folder_.data()) != nullptr, "there is no folder for links");
    for (const std::string& ending : endings_) std::filesystem::create_symlink(path_, path(ending));
}

MemoryFile::~MemoryFile() {
    std::error_code ignored;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
    close(descriptor_);
}

void MemoryFile::write(const void* data, std::size_t size) const {
    demand(ftruncate(descriptor_, 0) == 0 && pwrite(descriptor_, data, size, 0) == static_cast<ssize_t>(size),
           "a file in memory could not be written");
}

} // namespace raywise::fuzz
