#include "io/expected.h"
#include "io/words.h"

#include <algorithm>

namespace raywise::io {
namespace {

// What the header announces: [ST][C][N]OFF.
struct Header {
    bool texture = false;
    bool color = false;
    bool normal = false;
};

Header header_of(std::string_view word) {
    Header header;
    std::string_view rest = word;
    const auto takes = [&rest](std::string_view prefix) {
        if (rest.substr(0, prefix.size()) != prefix) return false;
        rest.remove_prefix(prefix.size());
        return true;
    };
    header.texture = takes("ST");
    header.color = takes("C");
    header.normal = takes("N");
    if (rest != "OFF") {
        throw Error(Status::ERROR_FILE_FORMAT, rest == "4OFF" || rest == "nOFF" || rest == "4nOFF"
                                                   ? "OFF files of other than 3 dimensions are not supported"
                                                   : "the file does not begin with OFF");
    }
    return header;
}

class OffCheck {
public:
    explicit OffCheck(std::string& text) : text_(text) {}

    Expected run() {
        // Looked for first: what follows it is not text.
        std::string_view start = text_;
        std::string_view first_line = take_line(start);
        take_word(first_line);
        if (take_word(first_line) == "BINARY")
            throw Error(Status::ERROR_FILE_FORMAT, "binary OFF files are not supported");
        if (text_.find('\0') != std::string::npos) throw Error(Status::ERROR_FILE_FORMAT, "the file is no text");
        unify();

        std::string_view rest = text_;
        const std::string_view word = take_word(rest);
        header_ = header_of(word);
        const auto begin = static_cast<std::size_t>(word.data() - text_.data());
        if (begin > 0 && (header_.texture || header_.color || header_.normal)) {
            throw Error(Status::ERROR_FILE_FORMAT, std::string(word) + " has to be the first word of the file");
        }
        // The reader takes its first line for the header, and the counts from the following ones.
        const std::size_t length = word.size();
        text_.erase(0, begin);
        if (length < text_.size()) text_[length] = '\n';
        position_ = std::min(length + 1, text_.size());

        std::string_view counts = row("the counts are missing");
        expected_.vertices = count(take_word(counts), "vertices");
        expected_.faces = count(take_word(counts), "faces");
        const std::string_view edges = take_word(counts);
        if (!edges.empty() && !number_of<std::int64_t>(edges)) {
            throw Error(Status::ERROR_FILE_FORMAT,
                        "line " + std::to_string(line_) + ": three counts have to follow OFF");
        }
        if (expected_.faces == 0) fail_no_faces();
        for (std::uint64_t i = 0; i < expected_.vertices; ++i) vertex(i);
        for (std::uint64_t i = 0; i < expected_.faces; ++i) face(i);
        // The reader would see the end of the file in the last number.
        text_ += '\n';
        if (edges.empty()) insert_edge_count();
        return expected_;
    }

private:
    void unify() {
        bool in_comment = false;
        for (std::size_t i = 0; i < text_.size(); ++i) {
            char& c = text_[i];
            if (c == '\r') c = i + 1 < text_.size() && text_[i + 1] == '\n' ? ' ' : '\n';
            if (c == '\n') in_comment = false;
            if (c == '#') in_comment = true;
            if (in_comment || c == '\t') c = ' ';
        }
    }

    void insert_edge_count() { text_.insert(end_of_counts_, " 0"); }

    // The next line that is not blank.
    std::string_view row(const std::string& what_is_missing) {
        while (position_ < text_.size()) {
            std::string_view rest = std::string_view(text_).substr(position_);
            const std::string_view line = take_line(rest);
            position_ = text_.size() - rest.size();
            ++line_;
            std::string_view words = line;
            if (take_word(words).empty()) continue;
            if (end_of_counts_ == 0)
                end_of_counts_ = static_cast<std::size_t>(line.data() - text_.data()) + line.size();
            return line;
        }
        throw Error(Status::ERROR_FILE_FORMAT, "the file is truncated: " + what_is_missing);
    }

    std::uint64_t count(std::string_view word, const char* elements) {
        const auto value = number_of<std::uint64_t>(word);
        if (!value) throw Error(Status::ERROR_FILE_FORMAT, std::string("the number of ") + elements + " is missing");
        if (*value > most_elements) fail_too_many(elements);
        return *value;
    }

    void vertex(std::uint64_t number) {
        const auto where = [&] { return "vertex " + std::to_string(number) + " (line " + std::to_string(line_) + ")"; };
        std::string_view words =
            row("vertex " + std::to_string(number) + " of " + std::to_string(expected_.vertices) + " is missing");
        for (int i = 0; i < (header_.normal ? 6 : 3); ++i) check_coordinate(take_word(words), where);
        trailing(words, where(), header_.texture ? 2 : 0);
    }

    void face(std::uint64_t number) {
        std::string_view words =
            row("face " + std::to_string(number) + " of " + std::to_string(expected_.faces) + " is missing");
        const auto corners = number_of<std::uint64_t>(take_word(words));
        if (!corners) fail_face(number, "the number of corners is missing");
        if (*corners < 3) fail_bad_polygon(number, *corners);
        for (std::uint64_t i = 0; i < *corners; ++i) {
            const std::string_view word = take_word(words);
            const auto index = number_of<std::int64_t>(word);
            if (!index) fail_face(number, word.empty() ? "it has too few corners" : quoted(word) + " is no index");
            if (*index < 0 || static_cast<std::uint64_t>(*index) >= expected_.vertices) {
                fail_index(number, std::to_string(*index), expected_.vertices);
            }
        }
        if (header_.color) {
            trailing(words, "face " + std::to_string(number), 0);
        } else {
            // Colours that the header does not announce would be taken for the next face.
            const auto begin = static_cast<std::size_t>(words.data() - text_.data());
            std::fill_n(text_.begin() + static_cast<std::ptrdiff_t>(begin), words.size(), ' ');
        }
    }

    // The reader knows colours of up to four numbers.
    void trailing(std::string_view words, const std::string& where, int more) const {
        int left = 0;
        while (!take_word(words).empty()) ++left;
        if (header_.color && left > 4 + more) throw Error(Status::ERROR_FILE_FORMAT, where + ": too many numbers");
        if (left < more) throw Error(Status::ERROR_FILE_FORMAT, where + ": texture coordinates are missing");
    }

    [[noreturn]] void fail_face(std::uint64_t number, const std::string& what) const {
        throw Error(Status::ERROR_FILE_FORMAT,
                    "face " + std::to_string(number) + " (line " + std::to_string(line_) + "): " + what);
    }

    std::string& text_;
    Header header_;
    Expected expected_;
    std::size_t position_ = 0;
    std::size_t end_of_counts_ = 0;
    std::uint64_t line_ = 1;
};

} // namespace

Expected prepare_off(std::string& text) { return OffCheck(text).run(); }

} // namespace raywise::io
