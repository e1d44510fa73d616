#include "io/ply_values.h"

#include "base/words.h"
#include "io/coordinates.h"

#include <cmath>
#include <cstring>

namespace raywise::io {
namespace {

// The two's complement number of `size` bytes.
std::int64_t extended(std::uint64_t bits, unsigned size) {
    const std::uint64_t sign = std::uint64_t{1} << (8 * size - 1);
    return static_cast<std::int64_t>((bits ^ sign) - sign);
}

template <class Float, class Bits>
double float_of(Bits bits) {
    Float value{};
    std::memcpy(&value, &bits, sizeof value);
    return static_cast<double>(value);
}

double number_of_bits(std::uint64_t bits, const PlyType& type) {
    switch (type.kind) {
        case PlyKind::floating:
            return type.size == 4 ? float_of<float>(static_cast<std::uint32_t>(bits)) : float_of<double>(bits);
        case PlyKind::signed_integer:
            return static_cast<double>(extended(bits, type.size));
        case PlyKind::unsigned_integer:
            break;
    }
    return static_cast<double>(bits);
}

} // namespace

PlyValues::PlyValues(std::string_view file, const PlyHeader& header, std::size_t first_byte)
    : rest_(file.substr(header.size)),
      encoding_(header.encoding),
      next_byte_(first_byte + header.size),
      value_byte_(next_byte_) {
    if (encoding_ != PlyEncoding::ascii) return;
    text_.emplace(rest_, header.lines + 1);
    std::uint64_t elements = 0;
    for (const PlyElement& element : header.elements) elements += element.properties.empty() ? 0 : element.count;
    has_rows_ = text_->count_rows() == elements;
}

double PlyValues::take_coordinate(const PlyProperty& property, std::uint64_t vertex) {
    constexpr const char* element = "vertex";
    if (text_) {
        const std::string_view word = take_word(element, vertex);
        const bool is_float32 = property.type.kind == PlyKind::floating && property.type.size == sizeof(float);
        return is_float32 ? static_cast<double>(coordinate32(*text_, word, element, vertex))
                          : coordinate64(*text_, word, element, vertex);
    }
    const double value = number_of_bits(take_bits(property.type, element, vertex), property.type);
    if (std::isfinite(value)) return value;
    fail(Status::ERROR_NOT_FINITE, std::string(element) + " " + std::to_string(vertex) + ": coordinate " +
                                       "xyz"[property.axis] + (std::isnan(value) ? " is NaN" : " is infinite"));
}

std::int64_t PlyValues::take_integer(const PlyType& type, const char* element, std::uint64_t number) {
    if (text_) {
        const std::string_view word = take_word(element, number);
        if (const auto value = number_of<std::int64_t>(word)) return *value;
        fail(Status::ERROR_FILE_FORMAT,
             std::string(element) + " " + std::to_string(number) + ": " + quoted(word) + " is no integer");
    }
    const std::uint64_t bits = take_bits(type, element, number);
    return type.kind == PlyKind::signed_integer ? extended(bits, type.size) : static_cast<std::int64_t>(bits);
}

void PlyValues::skip(const PlyProperty& property, const char* element, std::uint64_t number) {
    const auto take = [&] {
        if (text_) {
            take_word(element, number);
        } else {
            take_bits(property.type, element, number);
        }
    };
    if (property.count.size == 0) return take();
    const std::int64_t count = take_integer(property.count, element, number);
    if (count < 0) {
        fail(Status::ERROR_FILE_FORMAT,
             std::string(element) + " " + std::to_string(number) + ": a list of negative length");
    }
    for (std::int64_t i = 0; i < count; ++i) take();
}

// Rows may hold more than the header tells. Files that break their lines elsewhere have to be taken word by word.
void PlyValues::end_element() {
    std::string_view rest;
    if (has_rows_) text_->take_line(rest);
}

void PlyValues::fail(Status status, const std::string& reason) const {
    if (text_) text_->fail(status, reason);
    throw Error(status, reason + " (byte " + std::to_string(value_byte_) + ")");
}

std::string_view PlyValues::take_word(const char* element, std::uint64_t number) {
    const std::string_view word = text_->take_word();
    if (word.empty()) fail_truncated(element, number);
    return word;
}

std::uint64_t PlyValues::take_bits(const PlyType& type, const char* element, std::uint64_t number) {
    value_byte_ = next_byte_;
    if (rest_.size() < type.size) fail_truncated(element, number);
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < type.size; ++i) {
        const std::size_t at = encoding_ == PlyEncoding::little_endian ? type.size - 1 - i : i;
        bits = bits << 8 | static_cast<unsigned char>(rest_[at]);
    }
    rest_.remove_prefix(type.size);
    next_byte_ += type.size;
    return bits;
}

void PlyValues::fail_truncated(const char* element, std::uint64_t number) const {
    fail(Status::ERROR_FILE_FORMAT,
         "the file is truncated: " + std::string(element) + " " + std::to_string(number) + " is not complete");
}

} // namespace raywise::io
