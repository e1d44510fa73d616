// Lines, words and numbers of text files, whatever the locale.
#pragma once

#include "base/error.h"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace raywise::io {

// from_chars knows no plus sign.
inline std::string_view without_plus(std::string_view word) {
    return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

inline bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

// Takes the next word off the front of `text`; empty at its end.
inline std::string_view take_word(std::string_view& text) {
    std::size_t begin = 0;
    while (begin < text.size() && is_space(text[begin])) ++begin;
    std::size_t end = begin;
    while (end < text.size() && !is_space(text[end])) ++end;
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

// Takes the next line off the front of `text`, without its end.
inline std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
}

// A word of the file as a message may show it: not too long, and, since messages go to terminals, nothing but printable ASCII.
inline std::string quoted(std::string_view word) {
    std::string text = "\"";
    for (const char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
    return text + "\"";
}

template <class Integer>
std::optional<Integer> integer_of(std::string_view word) {
    word = without_plus(word);
    Integer value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

// Checks one coordinate. `where` makes the beginning of a message, e.g. "vertex 7 (line 9)".
template <class Where>
void check_coordinate(std::string_view word, const Where& where) {
    const std::string_view digits = without_plus(word);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (digits.empty() || error == std::errc::invalid_argument || end != digits.data() + digits.size()) {
        throw Error(Status::ERROR_FILE_FORMAT,
                    where() + (word.empty() ? " has too few coordinates" : ": " + quoted(word) + " is no number"));
    }
    // Out of range is either far too large or so small that it rounds to zero.
    const std::size_t exponent = digits.find_first_of("eE");
    const bool small = exponent == std::string_view::npos ? digits.find('.') <= (digits.front() == '-' ? 2u : 1u)
                                                          : digits.substr(exponent + 1, 1) == "-";
    const bool too_large = error == std::errc::result_out_of_range && !small;
    if (too_large || !(std::fabs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) {
        throw Error(Status::ERROR_NOT_FINITE, where() + ": " + quoted(word) + " is no finite float32");
    }
}

} // namespace raywise::io
