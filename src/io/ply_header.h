// What the header of a PLY file announces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace raywise::io {

enum class PlyKind {
    signed_integer,
    unsigned_integer,
    floating
};

struct PlyType {
    unsigned size = 0; // in bytes
    PlyKind kind = PlyKind::signed_integer;
};

struct PlyProperty {
    PlyType type;
    PlyType count;           // of a list's numbers; size 0: not a list
    int axis = -1;           // of a vertex coordinate
    bool is_corners = false; // of a face
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyEncoding {
    ascii,
    little_endian,
    big_endian
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0;    // in bytes
    std::uint64_t lines = 0; // of the header

    // Null where there is none. Throws Error(ERROR_FILE_FORMAT) where there are two.
    const PlyElement* find(std::string_view name) const;
};

// Throws Error(ERROR_FILE_FORMAT) with the line. `text`: the file, whose rest need be no text.
PlyHeader read_ply_header(std::string_view text);

} // namespace raywise::io
