// Texts as the C locale writes them, whatever locale the host program has chosen: they are read by programs and compared.
#pragma once

#include <locale.h>

#include <cstdint>
#include <string>

namespace raywise {

// The calling thread is in the C locale for as long as this lives; other threads keep theirs. For printf, strtod and what
// libraries do with them. (C++ streams have a locale of their own, which this does not touch.)
class PlainLocale {
public:
    PlainLocale();
    ~PlainLocale();
    PlainLocale(const PlainLocale&) = delete;
    PlainLocale& operator=(const PlainLocale&) = delete;

private:
    ::locale_t before_;
};

// printf into a string.
std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

// A duration in the unit that leaves one to three digits before the point; "-" for NaN.
std::string duration_text(double ns);

// Bytes likewise.
std::string size_text(double bytes);

// 1234567 as 1,234,567.
std::string grouped_text(std::uint64_t number);

// What the system says of an errno value, in English.
std::string error_text(int error);

} // namespace raywise
