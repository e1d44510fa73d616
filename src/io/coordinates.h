// Coordinates written as text.
#pragma once

#include "io/text_source.h"

#include <cstdint>
#include <string_view>

namespace raywise::io {

// Whether a float32 holds the number as it is.
bool fits_float32(double number);

// What the words of an element say, to the nearest number of the type. Each fails through `source`, naming the element, with
// ERROR_FILE_FORMAT for what is no decimal number and ERROR_NOT_FINITE for what is none that the type can hold.
double coordinate64(const TextSource& source, std::string_view word, const char* element, std::uint64_t number);
float coordinate32(const TextSource& source, std::string_view word, const char* element, std::uint64_t number);

} // namespace raywise::io
