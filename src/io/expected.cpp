#include "io/expected.h"

#include "base/error.h"

namespace raywise::io {

void fail_bad_polygon(std::uint64_t face, std::uint64_t corners) {
    throw Error(Status::ERROR_BAD_POLYGON, "face " + std::to_string(face) + " has " + std::to_string(corners) +
                                               (corners == 1 ? " corner" : " corners") + ", it needs at least 3");
}

void fail_index(std::uint64_t face, const std::string& index, std::uint64_t vertices) {
    throw Error(Status::ERROR_INDEX_OUT_OF_RANGE, "face " + std::to_string(face) + ": index " + index +
                                                      " is out of range, the mesh has " + std::to_string(vertices) +
                                                      " vertices");
}

void fail_too_many(const char* elements) {
    throw Error(Status::ERROR_TOO_MANY, std::string("more than ") + std::to_string(most_elements) + " " + elements);
}

void fail_no_faces() { throw Error(Status::ERROR_NO_FACES, "the file has no faces"); }

} // namespace raywise::io
