// Files that a test writes, in a folder that goes with it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace raywise {

class TemporaryFiles {
public:
    TemporaryFiles() {
        std::string name = (std::filesystem::temp_directory_path() / "raywise-test-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for temporary files");
        folder_ = name;
    }
    ~TemporaryFiles() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    TemporaryFiles(const TemporaryFiles&) = delete;
    TemporaryFiles& operator=(const TemporaryFiles&) = delete;

    const std::filesystem::path& folder() const { return folder_; }

    std::filesystem::path write(const std::string& name, const std::string& content) const {
        const std::filesystem::path path = folder_ / name;
        std::filesystem::remove(path); // some file systems wait for the disk when a file is overwritten
        std::ofstream file(path, std::ios::binary | std::ios::trunc);
        file.write(content.data(), static_cast<std::streamsize>(content.size()));
        if (!file.flush()) throw std::runtime_error("cannot write " + name);
        return path;
    }

private:
    std::filesystem::path folder_;
};

} // namespace raywise
