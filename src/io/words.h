// Coordinates in text files.
#pragma once

#include "base/error.h"
#include "base/words.h"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace raywise::io {

// A word of the file as a message may show it: not too long, and, since messages go to terminals, nothing but printable ASCII.
inline std::string quoted(std::string_view word) {
    std::string text = "\"";
    for (const char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
    return text + "\"";
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
