#include "base/format.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <new>

namespace raywise {
namespace {

// Made once and kept: the C libraries that we know hand out a constant and allocate nothing.
::locale_t plain_locale() {
    static const ::locale_t plain = [] {
        const ::locale_t made = ::newlocale(LC_ALL_MASK, "C", static_cast<::locale_t>(nullptr));
        if (made == static_cast<::locale_t>(nullptr)) throw std::bad_alloc();
        return made;
    }();
    return plain;
}

} // namespace

PlainLocale::PlainLocale() : before_(::uselocale(plain_locale())) {}
PlainLocale::~PlainLocale() { ::uselocale(before_); }

std::string format(const char* pattern, ...) {
    const PlainLocale plain;
    std::va_list arguments, again;
    va_start(arguments, pattern);
    va_copy(again, arguments);
    const int length = std::vsnprintf(nullptr, 0, pattern, arguments);
    va_end(arguments);
    std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
    std::vsnprintf(text.data(), text.size() + 1, pattern, again);
    va_end(again);
    return text;
}

std::string duration_text(double ns) {
    if (std::isnan(ns)) return "-";
    if (ns < 1e3) return format("%.3g ns", ns);
    if (ns < 1e6) return format("%.3g us", ns / 1e3);
    if (ns < 1e9) return format("%.3g ms", ns / 1e6);
    return format("%.4g s", ns / 1e9);
}

std::string size_text(double bytes) {
    if (bytes < 1024.0) return format("%.0f B", bytes);
    if (bytes < 1048576.0) return format("%.3g KiB", bytes / 1024.0);
    if (bytes < 1073741824.0) return format("%.3g MiB", bytes / 1048576.0);
    return format("%.3g GiB", bytes / 1073741824.0);
}

std::string grouped_text(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
    return digits;
}

std::string error_text(int error) { return ::strerror_l(error, plain_locale()); }

} // namespace raywise
