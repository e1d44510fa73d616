// Scenes and rays in a file, so that every program answers the same questions: made anew by each, they would depend on the
// sines and powers of a library that picks its code by the processor.
//
// The program that writes them and those that read them share this header and nothing else. Numbers are stored as the machine
// holds them; all machines concerned are little-endian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace raywise::isa {

struct InputRay {
    double origin[3];
    double tmin;
    double direction[3];
    double tmax;
};

// What projected structures are built for; as ViewFrame.
struct InputView {
    std::uint64_t along_direction; // 0: from a point
    double origin[3];
    double direction[3];
    double half_angle;
};

struct InputScene {
    std::string name;
    std::vector<std::array<double, 3>> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<InputRay> rays;
    std::vector<InputView> views;
};

class InputFile {
public:
    InputFile(const char* path, const char* mode) : path_(path), file_(std::fopen(path, mode), &std::fclose) {
        if (!file_) fail("cannot be opened");
    }

    template <class Elements> // a string or a vector
    void write(const Elements& elements) {
        const std::uint64_t count = elements.size();
        put(&count, sizeof count);
        put(elements.data(), count * sizeof elements[0]);
    }

    template <class Elements>
    void read(Elements& elements) {
        std::uint64_t count = 0;
        get(&count, sizeof count);
        if (count > 1u << 24) fail("is damaged");
        elements.resize(static_cast<std::size_t>(count));
        get(elements.data(), elements.size() * sizeof elements[0]);
    }

    void write(const InputScene& scene) {
        write(scene.name);
        write(scene.vertices);
        write(scene.triangles);
        write(scene.rays);
        write(scene.views);
    }

    // False at the end of the file.
    bool read(InputScene& scene) {
        const int next = std::fgetc(file_.get());
        if (next == EOF) return false;
        std::ungetc(next, file_.get());
        read(scene.name);
        read(scene.vertices);
        read(scene.triangles);
        read(scene.rays);
        read(scene.views);
        return true;
    }

    void close() {
        if (std::fclose(file_.release()) != 0) fail("cannot be written");
    }

private:
    [[noreturn]] void fail(const char* what) const { throw std::runtime_error(path_ + " " + what); }
    void put(const void* data, std::size_t bytes) {
        if (bytes > 0 && std::fwrite(data, bytes, 1, file_.get()) != 1) fail("cannot be written");
    }
    void get(void* data, std::size_t bytes) {
        if (bytes > 0 && std::fread(data, bytes, 1, file_.get()) != 1) fail("is cut off");
    }

    std::string path_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

} // namespace raywise::isa
