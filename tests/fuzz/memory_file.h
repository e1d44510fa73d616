// A file for functions that want a path: in memory, under names of the caller's choice.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace raywise::fuzz {

class MemoryFile {
public:
    // endings: names like ".obj" under which the file is to be found, too; they take a folder of links, which goes with this
    // object.
    explicit MemoryFile(const std::vector<std::string>& endings = {});
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    void write(const void* data, std::size_t size) const; // replaces the content
    const std::string& path() const { return path_; }
    std::string path(const std::string& ending) const { return folder_ + "/file" + ending; }

private:
    int descriptor_;
    std::string path_;
    std::string folder_;
    std::vector<std::string> endings_;
};

} // namespace raywise::fuzz
