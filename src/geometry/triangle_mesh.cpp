#include "geometry/triangle_mesh.h"

#include "base/error.h"
#include "geometry/array_checks.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

namespace raywise {
namespace {

template <class T>
T load(const std::byte* address) {
    T value;
    std::memcpy(&value, address, sizeof value); // the caller's arrays need not be aligned
    return value;
}

// Empty when the vertex can be used.
struct VertexFault {
    Status status = Status::OK;
    std::string text;
};

VertexFault fault_of(const Vec3& p, std::uint64_t vertex) {
    for (int axis = 0; axis < 3; ++axis) {
        const std::string where = "vertex " + std::to_string(vertex) + ": coordinate " + "xyz"[axis];
        if (!std::isfinite(p[axis])) {
            return {Status::ERROR_NOT_FINITE, where + (std::isnan(p[axis]) ? " is NaN" : " is infinite")};
        }
        if (std::fabs(p[axis]) > std::numeric_limits<float>::max()) {
            return {Status::ERROR_COORDINATE_RANGE, where + " is beyond the largest float32, 3.4e38"};
        }
    }
    return {};
}

bool is_usable(const Vec3& p) {
    constexpr double limit = std::numeric_limits<float>::max();
    return std::fabs(p.x) <= limit && std::fabs(p.y) <= limit && std::fabs(p.z) <= limit; // false for NaN
}

// Fewer vertices are looked at one by one: less code to fetch for a mesh that nothing is done with often.
constexpr std::uint64_t fewest_for_vectors = 64;

// `count` elements of three components, one after the other.
PageArray<std::byte> packed(const StridedArray& array, std::uint64_t count) {
    const std::size_t size = size_of(array.scalar);
    PageArray<std::byte> copy(count * 3 * size);
    std::byte* out = copy.data();
    if (array.is_packed()) {
        std::copy_n(array.data, copy.size(), out);
        return copy;
    }
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::byte* element = array.data + static_cast<std::ptrdiff_t>(i) * array.stride;
        for (int component = 0; component < 3; ++component, out += size) {
            std::memcpy(out, element + component * array.component_stride, size);
        }
    }
    return copy;
}

} // namespace

double StridedArray::number(std::uint64_t element, int component) const {
    const std::byte* address = place(element) + component * component_stride;
    return scalar == Scalar::float32 ? static_cast<double>(load<float>(address)) : load<double>(address);
}

TriangleMesh::TriangleMesh(const TriangleArrays& arrays, bool copy, bool skip_invalid, const std::string& name)
    : arrays_(arrays) {
    check(skip_invalid, name);
    if (copy) make_copy();
}

TriangleMesh::TriangleMesh(const TriangleMesh& before, const TriangleArrays& arrays, bool copy, bool skip_invalid,
                           const std::string& name)
    : arrays_(arrays) {
    if (arrays.indices.data == nullptr && before.arrays_.indices.data != nullptr) {
        if (arrays.triangle_count != before.arrays_.triangle_count) {
            throw Error(Status::ERROR_INVALID_ARGUMENT,
                        name + "triangle_count: it is " + std::to_string(arrays.triangle_count) +
                            ", the mesh whose indices are kept has " + std::to_string(before.arrays_.triangle_count) +
                            " triangles");
        }
        if (arrays.vertex_count != before.arrays_.vertex_count) {
            throw Error(Status::ERROR_INVALID_ARGUMENT, name + "vertex_count: it is " +
                                                            std::to_string(arrays.vertex_count) +
                                                            ", the mesh whose indices are kept has " +
                                                            std::to_string(before.arrays_.vertex_count) + " vertices");
        }
        arrays_.indices = before.arrays_.indices;
        index_copy_ = before.index_copy_;
    }
    check(skip_invalid, name);
    if (copy) make_copy();
}

void TriangleMesh::check(bool skip_invalid, const std::string& name) {
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (arrays_.vertex_count > most) {
        throw Error(Status::ERROR_TOO_MANY,
                    name + "vertex_count: " + std::to_string(arrays_.vertex_count) + " is above 4294967295");
    }
    if (arrays_.triangle_count >= most) {
        throw Error(Status::ERROR_TOO_MANY,
                    name + "triangle_count: " + std::to_string(arrays_.triangle_count) + " is above 4294967294");
    }
    const bool indexed = arrays_.indices.data != nullptr;
    if (!indexed && arrays_.vertex_count != 3 * arrays_.triangle_count) {
        throw Error(Status::ERROR_INVALID_ARGUMENT,
                    name + "indices: NULL needs 3 vertices per triangle, but vertex_count is " +
                        std::to_string(arrays_.vertex_count) + " and triangle_count " +
                        std::to_string(arrays_.triangle_count));
    }
    if (skip_invalid) {
        if (!vertices_are_usable() || (indexed && !indices_are_in_range())) find_invalid();
        return;
    }
    if (!vertices_are_usable()) {
        for (std::uint64_t i = 0; i < arrays_.vertex_count; ++i) {
            const Vec3 p = arrays_.vertices.vec3(i);
            if (is_usable(p)) continue;
            const VertexFault fault = fault_of(p, i);
            throw Error(fault.status, name + "vertices: " + fault.text);
        }
    }
    if (indexed && !indices_are_in_range()) {
        for (std::uint64_t i = 0; i < 3 * arrays_.triangle_count; ++i) {
            const std::uint64_t index = arrays_.indices.index(i / 3, static_cast<int>(i % 3));
            if (index < arrays_.vertex_count) continue;
            throw Error(Status::ERROR_INDEX_OUT_OF_RANGE,
                        name + "triangle " + std::to_string(i / 3) + ": index " + std::to_string(index) +
                            " is out of range, the mesh has " + std::to_string(arrays_.vertex_count) + " vertices");
        }
    }
}

bool TriangleMesh::vertices_are_usable() {
    const StridedArray& vertices = arrays_.vertices;
    if (vertices.is_packed() && arrays_.vertex_count >= fewest_for_vectors)
        return bound_points(vertices.data, arrays_.vertex_count, vertices.scalar == Scalar::float64, vertex_bounds_);
    Box bounds;
    bool usable = true;
    for (std::uint64_t i = 0; i < arrays_.vertex_count; ++i) {
        const Vec3 p = vertices.vec3(i);
        usable = is_usable(p) && usable;
        bounds.extend(p);
    }
    if (usable) vertex_bounds_ = bounds;
    return usable;
}

bool TriangleMesh::indices_are_in_range() const {
    const StridedArray& indices = arrays_.indices;
    // check() has seen that vertex_count is below 2^32.
    if (indices.is_packed() && indices.scalar == Scalar::uint32)
        return all_below(indices.data, 3 * arrays_.triangle_count, static_cast<std::uint32_t>(arrays_.vertex_count));
    std::uint64_t largest = 0;
    for (std::uint64_t i = 0; i < arrays_.triangle_count; ++i) {
        for (int corner = 0; corner < 3; ++corner) largest = std::max(largest, indices.index(i, corner));
    }
    return largest < arrays_.vertex_count || arrays_.triangle_count == 0;
}

void TriangleMesh::find_invalid() {
    const bool indexed = arrays_.indices.data != nullptr;
    PageVector<bool> invalid(arrays_.triangle_count, false);
    for (std::uint64_t i = 0; i < arrays_.triangle_count; ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint64_t index =
                indexed ? arrays_.indices.index(i, corner) : 3 * i + static_cast<std::uint64_t>(corner);
            if (index >= arrays_.vertex_count || !is_usable(arrays_.vertices.vec3(index))) invalid[i] = true;
        }
        invalid_count_ += invalid[i] ? 1 : 0;
    }
    if (invalid_count_ > 0) invalid_ = std::move(invalid);
}

void TriangleMesh::make_copy() {
    if (arrays_.indices.data != nullptr && index_copy_ == nullptr) {
        auto copy = std::make_shared<const PageArray<std::byte>>(packed_indices());
        arrays_.indices = {copy->data(), 3 * sizeof(std::uint32_t), sizeof(std::uint32_t), Scalar::uint32};
        index_copy_ = std::move(copy);
        // A null pointer means "no indices"; an empty array's is null.
        static const std::byte none{};
        if (arrays_.indices.data == nullptr) arrays_.indices.data = &none;
    }
    vertex_copy_ = packed(arrays_.vertices, arrays_.vertex_count);
    const auto size = static_cast<std::ptrdiff_t>(size_of(arrays_.vertices.scalar));
    arrays_.vertices = {vertex_copy_.data(), 3 * size, size, arrays_.vertices.scalar};
}

PageArray<std::byte> TriangleMesh::packed_indices() const {
    const StridedArray& indices = arrays_.indices;
    if (indices.scalar == Scalar::uint32) return packed(indices, arrays_.triangle_count);
    // 32 bits hold every valid index, and none is as large as the one that stands for all others.
    constexpr std::uint64_t invalid = std::numeric_limits<std::uint32_t>::max();
    PageArray<std::byte> copy(arrays_.triangle_count * 3 * sizeof(std::uint32_t));
    std::byte* out = copy.data();
    for (std::uint64_t i = 0; i < arrays_.triangle_count; ++i) {
        for (int corner = 0; corner < 3; ++corner, out += sizeof(std::uint32_t)) {
            const auto index = static_cast<std::uint32_t>(std::min(indices.index(i, corner), invalid));
            std::memcpy(out, &index, sizeof index);
        }
    }
    return copy;
}

} // namespace raywise
