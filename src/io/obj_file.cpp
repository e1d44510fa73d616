#include "io/coordinates.h"
#include "io/file_mesh.h"

#include "base/words.h"

#include <algorithm>
#include <array>

namespace raywise::io {
namespace {

// The words a line of an OBJ file may begin with; the format has more, and they only have to tell text from noise.
constexpr std::array known_words = {"v", "vt", "vn",     "vp",     "f",      "fo",  "l",    "p",   "g",
                                    "o", "s",  "usemtl", "mtllib", "cstype", "deg", "curv", "surf"};

// Takes off what a backslash at the end of a line continues; false where there is none.
bool take_backslash(std::string_view& line) {
    const std::size_t last = line.find_last_not_of(" \t\v\f");
    if (last == std::string_view::npos || line[last] != '\\') return false;
    line = line.substr(0, last);
    return true;
}

class ObjReader {
public:
    explicit ObjReader(std::string_view text) : source_(text) {}

    FileMesh read() {
        bool known = false;
        for (std::string_view line; source_.take_line(line);) {
            line = without_comment(line);
            bool is_continued = take_backslash(line);
            std::string_view words = line;
            const std::string_view keyword = take_word(words);
            known = known || std::find(known_words.begin(), known_words.end(), keyword) != known_words.end();
            const bool is_vertex = keyword == "v";
            const bool is_face = keyword == "f" || keyword == "fo"; // the second is what the oldest files write
            // A backslash continues these alone: others may end in one that belongs to a path.
            if (!is_vertex && !is_face) continue;
            line_ = source_.line();
            if (is_continued) words = continued(words);
            if (is_vertex) {
                vertex(words);
            } else {
                face(words);
            }
        }
        if (!known) source_.fail(Status::ERROR_FILE_FORMAT, "the file holds no line of an OBJ file, down to its last");
        // Faces may come before their vertices.
        if (vertices_needed_ > mesh_.vertex_count()) {
            fail(Status::ERROR_INDEX_OUT_OF_RANGE,
                 bad_index(neediest_face_, std::to_string(vertices_needed_), mesh_.vertex_count()), neediest_line_);
        }
        return std::move(mesh_);
    }

private:
    [[noreturn]] void fail(Status status, const std::string& reason) const { fail(status, reason, line_); }
    [[noreturn]] static void fail(Status status, const std::string& reason, std::uint64_t line) {
        throw Error(status, reason + " (line " + std::to_string(line) + ")");
    }

    // A statement's words with those of the lines that continue it.
    std::string_view continued(std::string_view words) {
        statement_ = words;
        bool more = true;
        for (std::string_view line; more && source_.take_line(line);) {
            line = without_comment(line);
            more = take_backslash(line);
            statement_ += ' ';
            statement_ += line;
        }
        return statement_;
    }

    // x y z, and what nobody asks for: a weight, a colour.
    void vertex(std::string_view words) {
        std::array<double, 3> position{};
        for (double& x : position) x = coordinate64(source_, take_word(words), "vertex", mesh_.vertex_count());
        mesh_.add_vertex(position);
    }

    void face(std::string_view words) {
        corners_.clear();
        for (std::string_view word = take_word(words); !word.empty(); word = take_word(words))
            corners_.push_back(corner(word));
        if (corners_.size() < 3)
            fail(Status::ERROR_BAD_POLYGON,
                 bad_polygon(mesh_.face_count(), static_cast<std::int64_t>(corners_.size())));
        if (corners_.size() > most_elements) fail(Status::ERROR_TOO_MANY, too_many("corners"));
        mesh_.begin_face(static_cast<std::uint32_t>(corners_.size()));
        for (const std::uint32_t vertex : corners_) mesh_.add_corner(vertex);
    }

    // vertex[/[texture][/[normal]]]
    std::uint32_t corner(std::string_view word) {
        const std::string_view number = word.substr(0, word.find('/'));
        const auto index = number_of<std::int64_t>(number);
        if (!index || word.find_first_not_of("0123456789/+-") != std::string_view::npos ||
            std::count(word.begin(), word.end(), '/') > 2) {
            fail(Status::ERROR_FILE_FORMAT,
                 "face " + std::to_string(mesh_.face_count()) + ": " + quoted(word) + " is no corner");
        }
        const std::int64_t vertex = *index > 0 ? *index - 1 : static_cast<std::int64_t>(mesh_.vertex_count()) + *index;
        if (*index == 0 || vertex < 0 || vertex > static_cast<std::int64_t>(most_elements)) {
            fail(Status::ERROR_INDEX_OUT_OF_RANGE,
                 bad_index(mesh_.face_count(), std::to_string(*index), mesh_.vertex_count()));
        }
        if (static_cast<std::uint64_t>(vertex) >= vertices_needed_) {
            vertices_needed_ = static_cast<std::uint64_t>(vertex) + 1;
            neediest_face_ = mesh_.face_count();
            neediest_line_ = line_;
        }
        return static_cast<std::uint32_t>(vertex);
    }

    TextSource source_;
    FileMesh mesh_;
    std::uint64_t line_ = 0; // that the statement begins on
    std::uint64_t vertices_needed_ = 0;
    std::uint64_t neediest_face_ = 0;
    std::uint64_t neediest_line_ = 0;
    std::string statement_;
    std::vector<std::uint32_t> corners_;
};

} // namespace

FileMesh read_obj(std::string_view bytes) { return ObjReader(without_byte_order_mark(bytes)).read(); }

} // namespace raywise::io
