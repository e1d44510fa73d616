// The numbers of a PLY file's body, one after the other, in the two ways that they are written.
#pragma once

#include "io/ply_header.h"
#include "io/text_source.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace raywise::io {

class PlyValues {
public:
    // `file`: with its header. first_byte: what stood before it.
    PlyValues(std::string_view file, const PlyHeader& header, std::size_t first_byte);

    // The next number. Each names the element when it fails.
    double take_coordinate(const PlyProperty& property, std::uint64_t vertex);
    std::int64_t take_integer(const PlyType& type, const char* element, std::uint64_t number);
    void skip(const PlyProperty& property, const char* element, std::uint64_t number);
    // Behind the last property of an element.
    void end_element();

    // Throws Error with the reason, and the line or byte of the latest value.
    [[noreturn]] void fail(Status status, const std::string& reason) const;

private:
    std::string_view take_word(const char* element, std::uint64_t number);
    // As an unsigned number, of however many bytes.
    std::uint64_t take_bits(const PlyType& type, const char* element, std::uint64_t number);
    [[noreturn]] void fail_truncated(const char* element, std::uint64_t number) const;

    std::string_view rest_; // of a binary file
    PlyEncoding encoding_;
    std::size_t next_byte_;          // where rest_ begins in the file
    std::size_t value_byte_;         // where the latest value did
    bool has_rows_ = false;          // an ASCII file with a line for each element
    std::optional<TextSource> text_; // of an ASCII file
};

} // namespace raywise::io
