#include "base/format.h"

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

std::string error_text(int error) { return ::strerror_l(error, plain_locale()); }

} // namespace raywise
