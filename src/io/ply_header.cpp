#include "io/ply_header.h"

#include "base/words.h"
#include "io/text_source.h"

#include <algorithm>

namespace raywise::io {
namespace {

constexpr struct {
    const char* name;
    PlyType type;
} known_types[] = {
    {"char", {1, PlyKind::signed_integer}},     {"int8", {1, PlyKind::signed_integer}},
    {"uchar", {1, PlyKind::unsigned_integer}},  {"uint8", {1, PlyKind::unsigned_integer}},
    {"short", {2, PlyKind::signed_integer}},    {"int16", {2, PlyKind::signed_integer}},
    {"ushort", {2, PlyKind::unsigned_integer}}, {"uint16", {2, PlyKind::unsigned_integer}},
    {"int", {4, PlyKind::signed_integer}},      {"int32", {4, PlyKind::signed_integer}},
    {"uint", {4, PlyKind::unsigned_integer}},   {"uint32", {4, PlyKind::unsigned_integer}},
    {"int64", {8, PlyKind::signed_integer}},    {"uint64", {8, PlyKind::unsigned_integer}},
    {"float", {4, PlyKind::floating}},          {"float32", {4, PlyKind::floating}},
    {"double", {8, PlyKind::floating}},         {"float64", {8, PlyKind::floating}},
};

constexpr struct {
    const char* name;
    PlyEncoding encoding;
} known_formats[] = {
    {"ascii", PlyEncoding::ascii},
    {"binary_little_endian", PlyEncoding::little_endian},
    {"binary_big_endian", PlyEncoding::big_endian},
};

// The row whose name the word is; null where there is none.
template <class Row, std::size_t count>
const Row* find_row(const Row (&rows)[count], std::string_view word) {
    const Row* const row =
        std::find_if(rows, rows + count, [word](const Row& known) { return is_word(word, known.name); });
    return row == rows + count ? nullptr : row;
}

class HeaderReader {
public:
    explicit HeaderReader(std::string_view text) : rest_(text), size_(text.size()) {}

    PlyHeader read() {
        skip_blank_lines();
        words_ = line();
        if (!is_word(take_word(words_), "ply") || !take_word(words_).empty()) fail("the file does not begin with ply");
        bool has_format = false;
        for (words_ = line();; words_ = line()) {
            const std::string_view keyword = take_word(words_);
            if (is_word(keyword, "end_header")) break;
            if (is_word(keyword, "format")) {
                has_format = true;
                format();
            } else if (is_word(keyword, "element")) {
                element();
            } else if (is_word(keyword, "property")) {
                if (header_.elements.empty()) fail("the header holds a property before the first element");
                property(header_.elements.back());
            } else if (!is_word(keyword, "comment") && !is_word(keyword, "obj_info") && !keyword.empty()) {
                fail("the header holds an unknown word: " + quoted(keyword));
            }
        }
        if (!has_format) fail("the header does not name the format");
        header_.size = size_ - rest_.size();
        return std::move(header_);
    }

private:
    [[noreturn]] void fail(const std::string& reason) const {
        throw Error(Status::ERROR_FILE_FORMAT, reason + " (line " + std::to_string(header_.lines) + ")");
    }

    void skip_blank_lines() {
        while (!rest_.empty() && is_space(rest_.front())) {
            const bool ends_line = rest_.front() == '\n' || (rest_.front() == '\r' && rest_.substr(0, 2) != "\r\n");
            if (ends_line) ++header_.lines;
            rest_.remove_prefix(1);
        }
        const std::size_t end = rest_.find_first_of("\r\n");
        const bool is_return = end != std::string_view::npos && rest_[end] == '\r' && rest_.substr(end, 2) != "\r\n";
        line_end_ = is_return ? '\r' : '\n';
    }

    // All lines end like the first, so that no number behind the header is taken for part of its end. CR is space before LF.
    std::string_view line() {
        if (rest_.empty()) fail("the file is truncated: the header has no end");
        ++header_.lines;
        return take_before(rest_, line_end_);
    }

    void format() {
        const std::string_view word = take_word(words_);
        const auto* row = find_row(known_formats, word);
        if (row == nullptr) fail("the header names an unknown format: " + quoted(word));
        header_.encoding = row->encoding;
    }

    void element() {
        PlyElement element;
        element.name = take_word(words_);
        const std::string_view word = take_word(words_);
        const auto count = number_of<std::uint64_t>(word);
        if (!count) {
            fail("the header does not say how many of element " + quoted(element.name) + " there are" +
                 (word.empty() ? "" : ": " + quoted(word) + " is no count"));
        }
        element.count = *count;
        header_.elements.push_back(std::move(element));
    }

    PlyType type(std::string_view word) const {
        const auto* row = find_row(known_types, word);
        if (row == nullptr) fail("the header names an unknown type: " + quoted(word));
        return row->type;
    }

    void property(PlyElement& element) {
        PlyProperty property;
        std::string_view word = take_word(words_);
        const bool is_list = is_word(word, "list");
        if (is_list) {
            property.count = type(take_word(words_));
            if (property.count.kind == PlyKind::floating) fail("the header counts a list with floats");
            word = take_word(words_);
        }
        property.type = type(word);
        const std::string_view name = take_word(words_);
        if (name.empty()) fail("the header holds a property without a name");
        if (element.name == "vertex" && !is_list && name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') {
            property.axis = name[0] - 'x';
        }
        if ((element.name == "face" || element.name == "tristrips") && is_list &&
            (name == "vertex_indices" || name == "vertex_index")) {
            property.is_corners = true;
            if (property.type.kind == PlyKind::floating) fail("vertex indices have to be integers");
        }
        element.properties.push_back(property);
    }

    std::string_view rest_;
    std::size_t size_;
    char line_end_ = '\n';
    std::string_view words_; // of the current line
    PlyHeader header_;
};

} // namespace

const PlyElement* PlyHeader::find(std::string_view name) const {
    const PlyElement* found = nullptr;
    for (const PlyElement& element : elements) {
        if (element.name != name) continue;
        if (found != nullptr) {
            throw Error(Status::ERROR_FILE_FORMAT,
                        "the header has two elements " + std::string(name) + " (line " + std::to_string(lines) + ")");
        }
        found = &element;
    }
    return found;
}

PlyHeader read_ply_header(std::string_view text) { return HeaderReader(text).read(); }

} // namespace raywise::io
