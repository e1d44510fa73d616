#include "contract/numbers.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace raywise::contract {

std::optional<double> number_of(const std::string& text) {
    // strtod takes more than the format has: leading blanks, "infinity", "nan(...)".
    const std::string digits = text.substr(!text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0);
    const double sign = !text.empty() && text[0] == '-' ? -1.0 : 1.0;
    if (digits == "inf") return sign * std::numeric_limits<double>::infinity();
    if (digits == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (digits.empty() || (digits[0] != '.' && (digits[0] < '0' || digits[0] > '9'))) return std::nullopt;
    char* end = nullptr;
    errno = 0;
    const double value = std::strtod(digits.c_str(), &end);
    if (end != digits.c_str() + digits.size() || std::isinf(value)) return std::nullopt;
    if (value == 0.0 && errno == ERANGE)
        return std::nullopt; // smaller than the smallest double, and not meant to be zero
    return sign * value;
}

std::string text_of(double number) {
    if (std::isnan(number)) return "nan";
    if (std::isinf(number)) return number < 0 ? "-inf" : "inf";
    char text[40];
    if (number == std::floor(number) && std::fabs(number) < 1e15) {
        std::snprintf(text, sizeof text, "%.0f", number);
        return text;
    }
    for (int digits = 1; digits <= 17; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, number);
        if (std::strtod(text, nullptr) == number) break;
    }
    return text;
}

bool is_float32(double number) {
    if (!std::isfinite(number)) return true;
    if (std::fabs(number) > static_cast<double>(std::numeric_limits<float>::max())) return false;
    return static_cast<double>(static_cast<float>(number)) == number;
}

} // namespace raywise::contract
