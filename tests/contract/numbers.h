// Numbers as text: decimal, C99 hexadecimal, inf, -inf and nan.
#pragma once

#include <optional>
#include <string>

namespace raywise::contract {

// Empty when the whole text is no such number, or one that no double comes near.
std::optional<double> number_of(const std::string& text);

// The shortest decimal that reads back as the same number, without an exponent for whole ones that are not huge.
std::string text_of(double number);

// Whether float32 holds it without loss. NaN and infinity count as held.
bool is_float32(double number);

} // namespace raywise::contract
