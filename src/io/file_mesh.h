// What a mesh file says: every vertex and every face, in its order.
//
// OpenMesh's readers pass over what they do not understand, believe counts and indices, round to float32, and merge or drop what
// does not suit a half-edge mesh. So each format has a reader of its own that checks the whole file, names what is wrong with
// it, and hands vertices and faces on in the one form that OpenMesh reads without any of that: a binary PLY file of numbers.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace raywise::io {

class FileMesh {
public:
    // Throw Error(ERROR_TOO_MANY) beyond most_elements.
    void add_vertex(const std::array<double, 3>& position);
    // Followed by as many add_corner.
    void begin_face(std::uint32_t corners);
    void add_corner(std::uint32_t vertex) { face_numbers_.push_back(vertex); }
    // A face with three vertices of its own, in a file that has no others.
    void add_facet(const std::array<std::array<double, 3>, 3>& corners);

    std::uint64_t vertex_count() const { return coordinates_.size() / 3; }
    std::uint64_t face_count() const { return face_count_; }
    const std::vector<double>& coordinates() const { return coordinates_; } // x, y, z of each vertex
    std::vector<double> take_coordinates() { return std::move(coordinates_); }
    // Whether they all are facets: nothing of them is left to be read then.
    bool has_facets() const { return has_facets_; }
    // Whether float32 holds every coordinate as it is.
    bool fits_float32() const { return fits_float32_; }

    // As a PLY file, in the machine's byte order. The faces are not kept.
    std::string take_ply();

private:
    std::vector<double> coordinates_;
    std::vector<std::uint32_t> face_numbers_; // of each face how many corners, and which
    std::uint64_t face_count_ = 0;
    bool has_facets_ = false;
    bool fits_float32_ = true;
};

// OpenMesh counts in int.
inline constexpr std::uint64_t most_elements = 2147483646;

// The reasons that several formats give.
std::string bad_polygon(std::uint64_t face, std::int64_t corners);
std::string bad_index(std::uint64_t face, const std::string& index, std::uint64_t vertices);
std::string too_many(const char* elements);

// The readers. They throw Error with ERROR_FILE_FORMAT, ERROR_BAD_POLYGON, ERROR_INDEX_OUT_OF_RANGE, ERROR_NOT_FINITE or
// ERROR_TOO_MANY, a reason, and the line (of text) or the byte (of anything else) where it was found.
FileMesh read_obj(std::string_view bytes);
FileMesh read_off(std::string_view bytes);
FileMesh read_ply(std::string_view bytes);
FileMesh read_stl(std::string_view bytes);

} // namespace raywise::io
