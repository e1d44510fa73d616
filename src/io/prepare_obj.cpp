#include "io/expected.h"
#include "io/words.h"

#include <algorithm>
#include <array>

namespace raywise::io {
namespace {

// The words a line of an OBJ file may begin with; the format has more, and they only have to tell text from noise.
constexpr std::array known_words = {"v", "vt", "vn",     "vp",     "f",      "l",   "p",    "g",
                                    "o", "s",  "usemtl", "mtllib", "cstype", "deg", "curv", "surf"};

// Makes one line of what is one line to OBJ: lone carriage returns end lines, backslashes continue them.
void unify_lines(std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\r') text[i] = i + 1 < text.size() && text[i + 1] == '\n' ? ' ' : '\n';
        if (text[i] != '\\') continue;
        std::size_t next = i + 1;
        while (next < text.size() && (text[next] == ' ' || text[next] == '\r')) ++next;
        if (next < text.size() && text[next] == '\n') text.replace(i, next + 1 - i, next + 1 - i, ' ');
    }
}

class ObjCheck {
public:
    explicit ObjCheck(std::string& text) : text_(text) {}

    Expected run() {
        if (text_.find('\0') != std::string::npos) throw Error(Status::ERROR_FILE_FORMAT, "the file is no text");
        unify_lines(text_);
        bool known = false;
        std::string_view rest = text_;
        while (!rest.empty()) {
            const std::size_t begin = text_.size() - rest.size();
            std::string_view line = take_line(rest);
            ++line_;
            if (const std::size_t comment = line.find('#'); comment != std::string_view::npos) {
                blank(begin + comment, line.size() - comment);
                line = line.substr(0, comment);
            }
            std::string_view words = line;
            const std::string_view first = take_word(words);
            if (first.empty()) continue;
            known = known || std::find(known_words.begin(), known_words.end(), first) != known_words.end();
            if (first == "v") {
                vertex(words);
            } else if (first == "f" || first == "fo") { // the second is what the oldest files write
                if (first == "fo") text_[begin + line.find("fo") + 1] = ' ';
                face(words);
            } else {
                blank(begin, line.size());
            }
        }
        if (!known && expected_.vertices == 0)
            throw Error(Status::ERROR_FILE_FORMAT, "the file holds no line of an OBJ file");
        if (expected_.faces == 0) fail_no_faces();
        // Faces may come before their vertices.
        if (vertices_needed_ > expected_.vertices)
            fail_index(neediest_face_, std::to_string(vertices_needed_), expected_.vertices);
        return std::move(expected_);
    }

private:
    void blank(std::size_t begin, std::size_t count) {
        std::fill_n(text_.begin() + static_cast<std::ptrdiff_t>(begin), count, ' ');
    }

    void vertex(std::string_view words) {
        if (expected_.vertices >= most_elements) fail_too_many("vertices");
        for (int axis = 0; axis < 3; ++axis) {
            check_coordinate(take_word(words), [&] {
                return "vertex " + std::to_string(expected_.vertices) + " (line " + std::to_string(line_) + ")";
            });
        }
        ++expected_.vertices;
    }

    void face(std::string_view words) {
        if (expected_.faces >= most_elements) fail_too_many("faces");
        corners_.clear();
        for (std::string_view word = take_word(words); !word.empty(); word = take_word(words))
            corners_.push_back(corner(word));
        if (corners_.size() < 3) fail_bad_polygon(expected_.faces, corners_.size());
        sorted_ = corners_;
        std::sort(sorted_.begin(), sorted_.end());
        if (std::adjacent_find(sorted_.begin(), sorted_.end()) != sorted_.end()) {
            expected_.repeated.push_back({static_cast<std::uint32_t>(expected_.faces), corners_});
        }
        ++expected_.faces;
    }

    // vertex[/[texture][/[normal]]]
    std::uint32_t corner(std::string_view word) {
        const std::string_view number = word.substr(0, word.find('/'));
        const auto index = number_of<std::int64_t>(number);
        if (!index || word.find_first_not_of("0123456789/+-") != std::string_view::npos ||
            std::count(word.begin(), word.end(), '/') > 2) {
            throw Error(Status::ERROR_FILE_FORMAT, "face " + std::to_string(expected_.faces) + " (line " +
                                                       std::to_string(line_) + "): " + quoted(word) + " is no corner");
        }
        const std::int64_t vertex = *index > 0 ? *index - 1 : static_cast<std::int64_t>(expected_.vertices) + *index;
        if (*index == 0 || vertex < 0 || vertex > static_cast<std::int64_t>(most_elements)) {
            fail_index(expected_.faces, std::to_string(*index), expected_.vertices);
        }
        if (static_cast<std::uint64_t>(vertex) >= vertices_needed_) {
            vertices_needed_ = static_cast<std::uint64_t>(vertex) + 1;
            neediest_face_ = expected_.faces;
        }
        return static_cast<std::uint32_t>(vertex);
    }

    std::string& text_;
    Expected expected_;
    std::uint64_t line_ = 0;
    std::uint64_t vertices_needed_ = 0;
    std::uint64_t neediest_face_ = 0;
    std::vector<std::uint32_t> corners_;
    std::vector<std::uint32_t> sorted_;
};

} // namespace

Expected prepare_obj(std::string& text) { return ObjCheck(text).run(); }

} // namespace raywise::io
