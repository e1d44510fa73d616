#include "io/text_source.h"

#include "base/words.h"

#include <algorithm>

namespace raywise::io {
namespace {

using namespace std::string_view_literals;

// The longer marks first: that of UTF-32 begins like that of UTF-16.
constexpr struct {
    std::string_view bytes;
    const char* encoding; // null: can be read
} byte_order_marks[] = {
    {"\xEF\xBB\xBF"sv, nullptr}, {"\xFF\xFE\0\0"sv, "UTF-32"}, {"\0\0\xFE\xFF"sv, "UTF-32"},
    {"\xFF\xFE"sv, "UTF-16"},    {"\xFE\xFF"sv, "UTF-16"},
};

} // namespace

std::string quoted(std::string_view word) {
    std::string text = "\"";
    for (const char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
    return text + "\"";
}

bool is_word(std::string_view word, std::string_view lower_case) {
    return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(), [](char c, char lower) {
        return (c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) == lower;
    });
}

std::string_view without_comment(std::string_view line) {
    std::size_t mark = line.find('#');
    while (mark != std::string_view::npos && mark > 0 && line[mark - 1] == '.') mark = line.find('#', mark + 1);
    return line.substr(0, mark);
}

std::string_view without_byte_order_mark(std::string_view bytes) {
    for (const auto& mark : byte_order_marks) {
        if (bytes.substr(0, mark.bytes.size()) != mark.bytes) continue;
        if (mark.encoding != nullptr) {
            throw Error(Status::ERROR_FILE_FORMAT, std::string("the file is ") + mark.encoding +
                                                       " text, which is not supported: save it as UTF-8 (byte 0)");
        }
        return bytes.substr(mark.bytes.size());
    }
    return bytes;
}

TextSource::TextSource(std::string_view text, std::uint64_t first_line)
    : text_(text.substr(0, text.find_last_not_of('\0') + 1)), line_(first_line), taken_line_(first_line) {
    for (Mark& end : ends_) end.position = text_.find(end.character);
    const std::size_t zero = text_.find('\0');
    if (zero == std::string_view::npos) return;
    std::string_view line;
    while (position_ <= zero) take_line(line);
    fail(Status::ERROR_FILE_FORMAT, "the file is no text: it holds a zero byte");
}

bool TextSource::take_line(std::string_view& line) {
    if (position_ >= text_.size()) return false;
    for (Mark& end : ends_) {
        if (end.position < position_) end.position = text_.find(end.character, position_);
    }
    const std::size_t end = std::min({ends_[0].position, ends_[1].position, text_.size()});
    line = text_.substr(position_, end - position_);
    taken_line_ = line_;
    position_ = end;
    skip_line_end();
    return true;
}

std::uint64_t TextSource::count_rows() const {
    TextSource ahead(*this);
    std::uint64_t rows = 0;
    for (std::string_view line; ahead.take_line(line);) rows += std::all_of(line.begin(), line.end(), is_space) ? 0 : 1;
    return rows;
}

std::string_view TextSource::take_word() {
    while (position_ < text_.size() && is_space(text_[position_])) {
        if (text_[position_] == '\n' || text_[position_] == '\r') {
            skip_line_end();
        } else {
            ++position_;
        }
    }
    return take_word_here();
}

std::string_view TextSource::take_word_of_line() {
    while (position_ < text_.size() && is_space(text_[position_]) && text_[position_] != '\n' &&
           text_[position_] != '\r') {
        ++position_;
    }
    return take_word_here();
}

std::string_view TextSource::peek_word_of_line() const {
    TextSource ahead(*this);
    return ahead.take_word_of_line();
}

void TextSource::fail(Status status, const std::string& reason) const {
    throw Error(status, reason + " (line " + std::to_string(taken_line_) + ")");
}

void TextSource::skip_line_end() {
    if (position_ >= text_.size()) return;
    position_ += text_.substr(position_, 2) == "\r\n" ? 2 : 1;
    ++line_;
}

std::string_view TextSource::take_word_here() {
    const std::size_t begin = position_;
    while (position_ < text_.size() && !is_space(text_[position_])) ++position_;
    taken_line_ = line_;
    return text_.substr(begin, position_ - begin);
}

} // namespace raywise::io
