#include "io/coordinates.h"
#include "io/file_mesh.h"

#include "base/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace raywise::io {
namespace {

constexpr std::size_t head_size = 84;  // 80 bytes of text, the number of facets
constexpr std::size_t facet_size = 50; // normal, three corners, two bytes

std::uint32_t little_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

// ---- binary ---------------------------------------------------------------------------------------

void binary_facet(FileMesh& mesh, std::string_view bytes, std::size_t at) {
    std::array<std::array<double, 3>, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t byte = at + 12 + 12 * c + 4 * axis;
            const std::uint32_t bits = little_endian(bytes.substr(byte, 4));
            float value;
            std::memcpy(&value, &bits, sizeof bits);
            if (!std::isfinite(value)) {
                throw Error(Status::ERROR_NOT_FINITE, "face " + std::to_string(mesh.face_count()) + ": coordinate " +
                                                          "xyz"[axis] + " of corner " + std::to_string(c) +
                                                          (std::isnan(value) ? " is NaN" : " is infinite") + " (byte " +
                                                          std::to_string(byte) + ")");
            }
            corners[c][axis] = static_cast<double>(value);
        }
    }
    mesh.add_facet(corners);
}

// What the two bytes behind a facet count, in files that have something there.
std::size_t payload_size(std::string_view bytes, std::size_t facet_at) {
    return little_endian(bytes.substr(facet_at + facet_size - 2, 2));
}

// Whether facets with their payloads, and payloads there are, end where the file does.
bool has_payloads(std::string_view bytes, std::uint32_t facets) {
    std::size_t at = head_size;
    for (std::uint32_t i = 0; i < facets; ++i) {
        if (bytes.size() - at < facet_size) return false;
        const std::size_t size = facet_size + payload_size(bytes, at);
        if (bytes.size() - at < size) return false;
        at += size;
    }
    return at == bytes.size() && at > head_size + facet_size * std::uint64_t{facets};
}

// How many facets a file holds whose size does not fit their count. A count that was left at zero, or is too low, says less than
// the bytes that are there; one that is too high means that bytes are missing.
std::uint64_t facets_by_size(std::string_view bytes, std::uint32_t counted) {
    const std::size_t body = bytes.size() - head_size;
    const std::uint64_t wanted = facet_size * std::uint64_t{counted};
    if (body > wanted && body % facet_size == 0) return body / facet_size;
    if (counted > 0 && body > wanted && body - wanted < facet_size) return counted; // a line end, or padding
    throw Error(Status::ERROR_FILE_FORMAT,
                "the file is " + std::string(body < wanted ? "truncated or no STL file" : "no STL file, or damaged") +
                    ": " + std::to_string(counted) + " facets would take " + std::to_string(head_size + wanted) +
                    " bytes, it has " + std::to_string(bytes.size()) + " (byte 80, where the facets are counted)");
}

FileMesh read_binary(std::string_view bytes, std::uint32_t counted) {
    FileMesh mesh;
    const bool is_plain = bytes.size() == head_size + facet_size * std::uint64_t{counted};
    const bool with_payloads = !is_plain && has_payloads(bytes, counted);
    const std::uint64_t facets = is_plain || with_payloads ? counted : facets_by_size(bytes, counted);
    std::size_t at = head_size;
    for (std::uint64_t i = 0; i < facets; ++i) {
        binary_facet(mesh, bytes, at);
        at += facet_size + (with_payloads ? payload_size(bytes, at) : 0);
    }
    return mesh;
}

// ---- ASCII ----------------------------------------------------------------------------------------

class AsciiReader {
public:
    explicit AsciiReader(std::string_view text) : source_(text) {}

    FileMesh read() {
        take(); // solid
        bool in_facet = name();
        bool ended = false;
        for (;;) {
            if (in_facet) {
                facet();
                ended = false;
            }
            take();
            in_facet = is_word(word_, "facet");
            if (in_facet) continue;
            if (word_.empty()) break;
            if (is_word(word_, "endsolid")) {
                in_facet = name();
                ended = !in_facet;
            } else if (is_word(word_, "solid") && ended) { // files may hold several
                in_facet = name();
                ended = false;
            } else {
                fail(quoted(word_) + " instead of facet or endsolid");
            }
        }
        if (!ended) fail("the file is truncated: endsolid is missing");
        return std::move(mesh_);
    }

private:
    [[noreturn]] void fail(const std::string& text) const {
        source_.fail(Status::ERROR_FILE_FORMAT, "face " + std::to_string(mesh_.face_count()) + ": " + text);
    }

    // The next word; end loop is one.
    void take() {
        word_ = source_.take_word();
        if (!is_word(word_, "end")) return;
        two_words_ = "end";
        two_words_ += source_.take_word();
        word_ = two_words_;
    }

    // What stands behind solid and endsolid: anything, to the end of the line. Files of one line have the first facet on it:
    // true then.
    bool name() {
        for (std::string_view word = source_.take_word_of_line(); !word.empty(); word = source_.take_word_of_line()) {
            if (is_word(word, "facet") && is_word(source_.peek_word_of_line(), "normal")) return true;
        }
        return false;
    }

    void expect(std::string_view wanted) {
        if (is_word(word_, wanted)) return;
        if (word_.empty()) fail("the file is truncated: " + std::string(wanted) + " is missing");
        fail(quoted(word_) + " instead of " + std::string(wanted));
    }

    void facet() {
        take();
        expect("normal");
        take();
        for (int i = 0; i < 3 && !is_word(word_, "outer"); ++i) take(); // not used, often nonsense, and missing in some
        expect("outer");
        take();
        expect("loop");
        std::array<std::array<double, 3>, 3> corners{};
        std::int64_t count = 0;
        for (take(); is_word(word_, "vertex"); take(), ++count) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double x = coordinate64(source_, source_.take_word(), "face", mesh_.face_count());
                if (count < 3) corners[static_cast<std::size_t>(count)][axis] = x;
            }
        }
        if (!is_word(word_, "endloop"))
            fail(word_.empty() ? "the file is truncated" : quoted(word_) + " instead of vertex or endloop");
        if (count < 3) source_.fail(Status::ERROR_BAD_POLYGON, bad_polygon(mesh_.face_count(), count));
        if (count > 3) fail("it has " + std::to_string(count) + " corners instead of 3");
        take();
        expect("endfacet");
        mesh_.add_facet(corners);
    }

    TextSource source_;
    std::string_view word_;
    std::string two_words_;
    FileMesh mesh_;
};

// A binary file may begin with the same word, but there is a zero byte in its count of facets or soon after it.
bool is_ascii(std::string_view text) {
    constexpr std::size_t start_size = 512;
    std::string_view rest = text;
    const std::string_view word = take_word(rest);
    if (!is_word(word, "solid")) return false;
    const std::size_t zero = text.find('\0', static_cast<std::size_t>(word.data() - text.data()));
    const bool in_start =
        zero != std::string_view::npos && zero < static_cast<std::size_t>(rest.data() - text.data()) + start_size;
    return !in_start || text.find_first_not_of('\0', zero) == std::string_view::npos; // padding
}

} // namespace

// Binary where the size fits the count of facets, whatever the first word says.
FileMesh read_stl(std::string_view bytes) {
    const std::uint32_t counted = bytes.size() >= head_size ? little_endian(bytes.substr(80, 4)) : 0;
    const bool fits = bytes.size() >= head_size && bytes.size() == head_size + facet_size * std::uint64_t{counted};
    if (!fits) {
        const std::string_view text = without_byte_order_mark(bytes);
        if (is_ascii(text)) return AsciiReader(text).read();
        if (bytes.size() < head_size) {
            throw Error(Status::ERROR_FILE_FORMAT,
                        "the file is too short for an STL file (byte " + std::to_string(bytes.size()) + ")");
        }
    }
    return read_binary(bytes, counted);
}

} // namespace raywise::io
