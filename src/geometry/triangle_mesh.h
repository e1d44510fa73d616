// One triangle mesh: strided arrays of the caller's, or packed copies of them, read as double precision corners.
#pragma once

#include "base/box.h"
#include "base/page_array.h"
#include "base/vec.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>

namespace raywise {

// An element type of the caller's arrays.
enum class Scalar {
    float32,
    float64,
    uint8,
    uint32,
    uint64
};

constexpr std::size_t size_of(Scalar scalar) {
    return scalar == Scalar::uint8 ? 1 : scalar == Scalar::float32 || scalar == Scalar::uint32 ? 4 : 8;
}

// Component c of element i is at data + i * stride + c * component_stride; no alignment is asked for.
struct StridedArray {
    const std::byte* data = nullptr;
    std::ptrdiff_t stride = 0;
    std::ptrdiff_t component_stride = 0;
    Scalar scalar = Scalar::float32;

    const std::byte* place(std::uint64_t element) const { return data + static_cast<std::ptrdiff_t>(element) * stride; }
    double number(std::uint64_t element, int component = 0) const;       // float32 or float64
    std::uint64_t index(std::uint64_t element, int component = 0) const; // uint32 or uint64
    Vec3 vec3(std::uint64_t element) const;                              // float32 or float64
    Vec3f vec3f(std::uint64_t element) const;                            // float32

    bool has_rows() const { return component_stride == static_cast<std::ptrdiff_t>(size_of(scalar)); } // side by side
    bool is_packed() const { return has_rows() && stride == 3 * component_stride; } // of three components
};

// Written for speed, and inline: every triangle test begins here. memcpy, because the caller's arrays need not be aligned.
inline std::uint64_t StridedArray::index(std::uint64_t element, int component) const {
    const std::byte* address = place(element) + component * component_stride;
    if (scalar == Scalar::uint32) {
        std::uint32_t index;
        std::memcpy(&index, address, sizeof index);
        return index;
    }
    std::uint64_t index;
    std::memcpy(&index, address, sizeof index);
    return index;
}

inline Vec3f StridedArray::vec3f(std::uint64_t element) const {
    const std::byte* address = place(element);
    float x, y, z;
    std::memcpy(&x, address, sizeof x);
    std::memcpy(&y, address + component_stride, sizeof y);
    std::memcpy(&z, address + 2 * component_stride, sizeof z);
    return {x, y, z};
}

inline Vec3 StridedArray::vec3(std::uint64_t element) const {
    if (scalar == Scalar::float32) return Vec3(vec3f(element));
    const std::byte* address = place(element);
    double x, y, z;
    std::memcpy(&x, address, sizeof x);
    std::memcpy(&y, address + component_stride, sizeof y);
    std::memcpy(&z, address + 2 * component_stride, sizeof z);
    return {x, y, z};
}

struct TriangleArrays {
    StridedArray vertices;
    std::uint64_t vertex_count = 0;
    StridedArray indices; // data null: triangle i has the vertices 3i, 3i + 1, 3i + 2
    std::uint64_t triangle_count = 0;
};

using Corners = std::array<Vec3, 3>;
using CornersF = std::array<Vec3f, 3>;

class TriangleMesh {
public:
    // Checks every vertex and index. Throws Error with ERROR_NOT_FINITE, ERROR_COORDINATE_RANGE, ERROR_INDEX_OUT_OF_RANGE or
    // ERROR_TOO_MANY, naming the element, unless skip_invalid. copy: keep packed copies instead of the caller's arrays. name: where
    // the arrays are in the caller's eyes, in front of every message.
    TriangleMesh(const TriangleArrays& arrays, bool copy, bool skip_invalid, const std::string& name = {});
    // The same for a mesh whose vertices have moved: without indices it has those of `before`, and then has to have as many vertices
    // and triangles.
    TriangleMesh(const TriangleMesh& before, const TriangleArrays& arrays, bool copy, bool skip_invalid,
                 const std::string& name = {});
    TriangleMesh(const TriangleMesh&) = delete; // its arrays may point into itself
    TriangleMesh& operator=(const TriangleMesh&) = delete;

    std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(arrays_.triangle_count); }
    Corners corners(std::uint32_t triangle) const {
        const std::array<std::uint64_t, 3> v = vertices_of(triangle);
        return {arrays_.vertices.vec3(v[0]), arrays_.vertices.vec3(v[1]), arrays_.vertices.vec3(v[2])};
    }
    // Whether the vertices are float32; then the corners can be had as they are.
    bool is_float32() const { return arrays_.vertices.scalar == Scalar::float32; }
    CornersF corners_float32(std::uint32_t triangle) const {
        const std::array<std::uint64_t, 3> v = vertices_of(triangle);
        return {arrays_.vertices.vec3f(v[0]), arrays_.vertices.vec3f(v[1]), arrays_.vertices.vec3f(v[2])};
    }

    // Asks the caches for what corners() reads of a triangle, valid or not: its indices, and the vertices that they name, once they are there.
    // Inline by force: a call to a function that does nothing but that is one that GCC takes away.
    [[gnu::always_inline]] void prefetch_indices(std::uint32_t triangle) const {
        if (arrays_.indices.data != nullptr) __builtin_prefetch(arrays_.indices.place(triangle));
    }
    [[gnu::always_inline]] void prefetch_vertices(std::uint32_t triangle) const {
        for (const std::uint64_t vertex : vertices_of(triangle)) {
            if (vertex < arrays_.vertex_count) __builtin_prefetch(arrays_.vertices.place(vertex));
        }
    }

    // Where the corners are, for those who read many.
    const TriangleArrays& arrays() const { return arrays_; }

    // False for triangles with an invalid vertex or index; they have no corners.
    bool is_valid(std::uint32_t triangle) const { return invalid_.empty() || !invalid_[triangle]; }
    std::uint64_t invalid_count() const { return invalid_count_; }

    // Of all vertices, whether or not a triangle has them; empty where one of them cannot be used.
    const Box& vertex_bounds() const { return vertex_bounds_; }

    // Memory of the copies; that of indices is counted by each mesh that has them.
    std::size_t bytes() const {
        return vertex_copy_.bytes() + (index_copy_ ? index_copy_->bytes() : 0) + invalid_.size() / 8;
    }

private:
    std::array<std::uint64_t, 3> vertices_of(std::uint32_t triangle) const {
        if (arrays_.indices.data == nullptr) {
            const std::uint64_t first = std::uint64_t{3} * triangle;
            return {first, first + 1, first + 2};
        }
        return {arrays_.indices.index(triangle, 0), arrays_.indices.index(triangle, 1),
                arrays_.indices.index(triangle, 2)};
    }
    void check(bool skip_invalid, const std::string& name);
    bool vertices_are_usable(); // and bounds them
    bool indices_are_in_range() const;
    void find_invalid();
    void make_copy();
    PageArray<std::byte> packed_indices() const;

    TriangleArrays arrays_;
    PageArray<std::byte> vertex_copy_;
    std::shared_ptr<const PageArray<std::byte>> index_copy_; // one for all meshes that differ in their vertices alone
    PageVector<bool> invalid_;                               // empty when all are valid
    std::uint64_t invalid_count_ = 0;
    Box vertex_bounds_;
};

} // namespace raywise
