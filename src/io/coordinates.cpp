#include "io/coordinates.h"

#include "base/words.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <string>

namespace raywise::io {
namespace {

// Whether a number that is out of a type's range is too large for it, rather than so small that it is zero.
bool is_large(std::string_view digits) {
    if (digits.front() == '-') digits.remove_prefix(1);
    const std::size_t mantissa_end = std::min(digits.find_first_of("eE"), digits.size());
    const std::string_view mantissa = digits.substr(0, mantissa_end);
    const std::size_t first = mantissa.find_first_of("123456789");
    if (first == std::string_view::npos) return false;
    const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
    const std::int64_t power = point - static_cast<std::int64_t>(first); // of the leading digit, to within one

    if (mantissa_end == digits.size()) return power > 0;
    const std::string_view exponent = digits.substr(mantissa_end + 1);
    const auto value = number_of<std::int64_t>(exponent);
    if (!value) return exponent.front() != '-'; // too long to count
    return *value > -power;
}

template <class Number>
Number coordinate(const TextSource& source, std::string_view word, const char* element, std::uint64_t number) {
    const auto fail = [&](Status status, const std::string& what) {
        source.fail(status, std::string(element) + " " + std::to_string(number) + what);
    };
    if (word.empty()) fail(Status::ERROR_FILE_FORMAT, " has too few coordinates");
    const std::string_view digits = without_plus(word);
    Number value{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) {
        const bool has_comma = word.find(',') != std::string_view::npos;
        fail(Status::ERROR_FILE_FORMAT,
             ": " + quoted(word) + " is no number" + (has_comma ? ", a decimal point has to be a point" : ""));
    }
    if (error == std::errc::result_out_of_range ? is_large(digits) : !std::isfinite(value)) {
        fail(Status::ERROR_NOT_FINITE,
             ": " + quoted(word) + " is no finite " + (sizeof value == sizeof(float) ? "float32" : "number"));
    }
    if (error == std::errc::result_out_of_range) return digits.front() == '-' ? -Number{} : Number{};
    return value;
}

} // namespace

bool fits_float32(double number) {
    return std::fabs(number) <= static_cast<double>(std::numeric_limits<float>::max()) &&
           static_cast<double>(static_cast<float>(number)) == number;
}

double coordinate64(const TextSource& source, std::string_view word, const char* element, std::uint64_t number) {
    return coordinate<double>(source, word, element, number);
}

float coordinate32(const TextSource& source, std::string_view word, const char* element, std::uint64_t number) {
    return coordinate<float>(source, word, element, number);
}

} // namespace raywise::io
