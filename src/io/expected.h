// What a file holds by our own count, made before OpenMesh sees it.
//
// OpenMesh's readers pass over what they do not understand, believe counts and indices, and merge or drop what does
// not suit a half-edge mesh. So each format has a function that checks the whole file first, names what is wrong with
// it, and takes out what a reader would stumble over. What OpenMesh then delivers has to agree with this count.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::io {

// A face that has a corner twice. It is legal (its triangles have no area), but the OBJ reader shortens or drops it.
struct RepeatedCorners {
    std::uint32_t face;
    std::vector<std::uint32_t> corners;
};

struct Expected {
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
    std::vector<RepeatedCorners> repeated; // in the order of the faces
};

// Each checks `text` and rewrites it for the reader of its kind. All throw Error with ERROR_FILE_FORMAT,
// ERROR_NO_FACES, ERROR_BAD_POLYGON, ERROR_INDEX_OUT_OF_RANGE, ERROR_NOT_FINITE or ERROR_TOO_MANY.

// Keeps vertices and faces only, so that no material file is looked for.
Expected prepare_obj(std::string& text);
// Takes out comments, and colours that the header does not announce.
Expected prepare_off(std::string& text);
// Keeps coordinates and corner lists only: the reader loses its way in other lists.
Expected prepare_ply(std::string& text);

// OpenMesh counts in int.
inline constexpr std::uint64_t most_elements = 2147483646;

[[noreturn]] void fail_bad_polygon(std::uint64_t face, std::uint64_t corners);
[[noreturn]] void fail_index(std::uint64_t face, const std::string& index, std::uint64_t vertices);
[[noreturn]] void fail_too_many(const char* elements);
[[noreturn]] void fail_no_faces();

} // namespace raywise::io
