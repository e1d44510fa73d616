#include "io/stl_file.h"

#include "io/expected.h"
#include "io/words.h"

#include <array>
#include <cstring>

namespace raywise::io {
namespace {

constexpr std::size_t head_size = 84;  // 80 bytes of text, the number of facets
constexpr std::size_t facet_size = 50; // normal, three corners, two bytes

std::uint32_t little_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

void add_facet(LoadedMesh& mesh, const std::array<float, 9>& corners) {
    if (mesh.vertex_count() + 3 > most_elements) fail_too_many("vertices");
    for (std::size_t i = 0; i < 9; ++i) {
        if (std::isfinite(corners[i])) continue;
        throw Error(Status::ERROR_NOT_FINITE, "face " + std::to_string(mesh.face_count) + ": coordinate " +
                                                  "xyz"[i % 3] + " of corner " + std::to_string(i / 3) +
                                                  (std::isnan(corners[i]) ? " is NaN" : " is infinite"));
    }
    const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
    mesh.face_of_triangle.push_back(mesh.face_count++);
}

LoadedMesh read_binary(std::string_view bytes, std::uint32_t facets) {
    LoadedMesh mesh;
    for (std::uint32_t i = 0; i < facets; ++i) {
        const std::string_view facet = bytes.substr(head_size + facet_size * i, facet_size);
        std::array<float, 9> corners{};
        for (std::size_t c = 0; c < 9; ++c) {
            const std::uint32_t bits = little_endian(facet.substr(12 + 4 * c, 4));
            std::memcpy(&corners[c], &bits, sizeof bits);
        }
        add_facet(mesh, corners);
    }
    return mesh;
}

bool is_word(std::string_view word, std::string_view lower) {
    if (word.size() != lower.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
        const char c = word[i] >= 'A' && word[i] <= 'Z' ? static_cast<char>(word[i] - 'A' + 'a') : word[i];
        if (c != lower[i]) return false;
    }
    return true;
}

class Ascii {
public:
    explicit Ascii(std::string_view text) : rest_(text) {}

    LoadedMesh read() {
        take_line(rest_); // solid and a name, which may be anything
        bool ended = false;
        for (std::string_view word = take_word(rest_); !word.empty(); word = take_word(rest_)) {
            if (is_word(word, "facet")) {
                facet();
                ended = false;
            } else if (is_word(word, "endsolid")) {
                take_line(rest_);
                ended = true;
            } else if (is_word(word, "solid") && ended) { // files may hold several
                take_line(rest_);
                ended = false;
            } else {
                fail(quoted(word) + " instead of facet or endsolid");
            }
        }
        if (!ended) fail("the file is truncated: endsolid is missing");
        return std::move(mesh_);
    }

private:
    [[noreturn]] void fail(const std::string& text) const {
        throw Error(Status::ERROR_FILE_FORMAT, "face " + std::to_string(mesh_.face_count) + ": " + text);
    }
    void expect(std::string_view wanted) {
        const std::string_view word = take_word(rest_);
        if (is_word(word, wanted)) return;
        if (word.empty()) fail("the file is truncated: " + std::string(wanted) + " is missing");
        fail(quoted(word) + " instead of " + std::string(wanted));
    }

    void facet() {
        expect("normal");
        for (int i = 0; i < 3; ++i) take_word(rest_); // not used, and often nonsense
        expect("outer");
        expect("loop");
        std::array<float, 9> corners{};
        std::uint64_t count = 0;
        std::string_view word = take_word(rest_);
        for (; is_word(word, "vertex"); word = take_word(rest_), ++count) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::string_view word_here = take_word(rest_);
                check_coordinate(word_here, [this] { return "face " + std::to_string(mesh_.face_count); });
                const std::string_view number = without_plus(word_here);
                float value = 0.0f; // stays zero for what is too small for a float32
                std::from_chars(number.data(), number.data() + number.size(), value);
                if (count < 3) corners[3 * count + axis] = value;
            }
        }
        if (!is_word(word, "endloop"))
            fail(word.empty() ? "the file is truncated" : quoted(word) + " instead of vertex or endloop");
        if (count < 3) fail_bad_polygon(mesh_.face_count, count);
        if (count > 3) fail("it has " + std::to_string(count) + " corners instead of 3");
        expect("endfacet");
        add_facet(mesh_, corners);
    }

    std::string_view rest_;
    LoadedMesh mesh_;
};

} // namespace

LoadedMesh read_stl(std::string_view bytes) {
    LoadedMesh mesh;
    std::string_view words = bytes.substr(0, 200);
    const bool says_solid = is_word(take_word(words), "solid");
    const std::uint32_t facets = bytes.size() >= head_size ? little_endian(bytes.substr(80, 4)) : 0;
    if (bytes.size() >= head_size && bytes.size() == head_size + facet_size * std::uint64_t{facets}) {
        mesh = read_binary(bytes, facets);
    } else if (says_solid && bytes.find('\0') == std::string_view::npos) {
        mesh = Ascii(bytes).read();
    } else {
        throw Error(Status::ERROR_FILE_FORMAT,
                    bytes.size() < head_size
                        ? "the file is too short for an STL file"
                        : "the file is truncated or no STL file: " + std::to_string(facets) + " facets would take " +
                              std::to_string(head_size + facet_size * std::uint64_t{facets}) + " bytes, it has " +
                              std::to_string(bytes.size()));
    }
    if (mesh.face_count == 0) fail_no_faces();
    return mesh;
}

} // namespace raywise::io
