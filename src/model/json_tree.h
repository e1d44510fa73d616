// A parsed JSON text as plain values.
//
// The parsing is nlohmann-json's; its own tree is not used inside the library, because its destructor allocates and is
// noexcept: where memory has run out it ends the process instead of throwing.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace raywise {

struct JsonNode {
    enum class Type {
        null,
        boolean,
        whole,
        number,
        text,
        list,
        object
    };

    Type type = Type::null;
    bool boolean = false;
    std::uint64_t whole = 0; // of Type::whole: an unsigned integer
    double number = 0.0;     // of Type::whole and Type::number
    std::string text;
    std::vector<std::pair<std::string, JsonNode>> members; // of an object, and of a list with empty names

    const JsonNode* find(const std::string& name) const;
    // Enough to recognise a value by in a message.
    std::string excerpt() const;
};

// Parses a whole text. Throws Error(PROFILE_MALFORMED), or PROFILE_RANGE for a number that float64 cannot hold. Depth is bounded, and
// no member may be there twice.
JsonNode parse_json(const std::string& text);

// A text with quotes and escapes, and the shortest digits that read back as the same number ("null" for NaN and infinities).
std::string json_text(const std::string& text);
std::string json_number(double number);

} // namespace raywise
