#include "io/file_mesh.h"

#include "base/error.h"
#include "io/coordinates.h"

#include <cstring>

namespace raywise::io {
namespace {

bool is_little_endian() {
    const std::uint16_t one = 1;
    unsigned char first = 0;
    std::memcpy(&first, &one, 1);
    return first == 1;
}

template <class Number>
void append(std::string& bytes, const Number* numbers, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(numbers), count * sizeof(Number));
}

} // namespace

void FileMesh::add_vertex(const std::array<double, 3>& position) {
    if (vertex_count() >= most_elements) throw Error(Status::ERROR_TOO_MANY, too_many("vertices"));
    for (const double coordinate : position) fits_float32_ = fits_float32_ && io::fits_float32(coordinate);
    coordinates_.insert(coordinates_.end(), position.begin(), position.end());
}

void FileMesh::begin_face(std::uint32_t corners) {
    if (face_count_ >= most_elements) throw Error(Status::ERROR_TOO_MANY, too_many("faces"));
    face_numbers_.push_back(corners);
    ++face_count_;
}

void FileMesh::add_facet(const std::array<std::array<double, 3>, 3>& corners) {
    for (const auto& corner : corners) add_vertex(corner);
    ++face_count_;
    has_facets_ = true;
}

std::string FileMesh::take_ply() {
    const std::string type = fits_float32_ ? "float" : "double";
    std::string bytes = std::string("ply\nformat binary_") + (is_little_endian() ? "little" : "big") +
                        "_endian 1.0\nelement vertex " + std::to_string(vertex_count()) + "\nproperty " + type +
                        " x\nproperty " + type + " y\nproperty " + type + " z\nelement face " +
                        std::to_string(face_count_) + "\nproperty list int int vertex_indices\nend_header\n";
    const std::size_t coordinate_size = fits_float32_ ? sizeof(float) : sizeof(double);
    bytes.reserve(bytes.size() + coordinates_.size() * coordinate_size + face_numbers_.size() * sizeof(std::uint32_t));
    if (fits_float32_) {
        for (const double coordinate : coordinates_) {
            const auto rounded = static_cast<float>(coordinate);
            append(bytes, &rounded, 1);
        }
    } else {
        append(bytes, coordinates_.data(), coordinates_.size());
    }
    append(bytes, face_numbers_.data(), face_numbers_.size());
    face_numbers_ = {};
    return bytes;
}

std::string bad_polygon(std::uint64_t face, std::int64_t corners) {
    return "face " + std::to_string(face) + " has " + std::to_string(corners) +
           (corners == 1 ? " corner" : " corners") + ", it needs at least 3";
}

std::string bad_index(std::uint64_t face, const std::string& index, std::uint64_t vertices) {
    return "face " + std::to_string(face) + ": index " + index + " is out of range, the mesh has " +
           std::to_string(vertices) + " vertices";
}

std::string too_many(const char* elements) {
    return std::string("more than ") + std::to_string(most_elements) + " " + elements;
}

} // namespace raywise::io
