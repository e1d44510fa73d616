#include "batch/hit_arrays.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace raywise {
namespace {

// value_of(k) to one component of elements[k], for each k. The caller's arrays need not be aligned.
template <class Value, class ValueOf>
void store(const OutputArray& array, int component, const Elements& elements, const ValueOf& value_of) {
    // Bytes written might be those of the arguments, as far as the compiler knows.
    const Elements to = elements;
    const std::ptrdiff_t stride = array.stride;
    std::byte* const data = array.data + component * array.component_stride;
    for (std::size_t k = 0; k < to.count(); ++k) {
        const auto value = static_cast<Value>(value_of(k));
        std::memcpy(data + static_cast<std::ptrdiff_t>(to[k]) * stride, &value, sizeof value);
    }
}

template <class ValueOf>
void write_numbers(const OutputArray& array, int component, const Elements& elements, const ValueOf& value_of) {
    if (!array.wanted()) return;
    if (array.scalar == Scalar::float32) {
        store<float>(array, component, elements, value_of);
    } else {
        store<double>(array, component, elements, value_of);
    }
}

void write_ids(const OutputArray& array, const Elements& elements, const Hit* hits, std::uint32_t Hit::*id) {
    if (!array.wanted()) return;
    if (array.scalar == Scalar::uint32) {
        store<std::uint32_t>(array, 0, elements, [=](std::size_t k) { return hits[k].*id; });
    } else {
        store<std::uint64_t>(array, 0, elements, [=](std::size_t k) {
            return hits[k].*id == invalid_id ? std::numeric_limits<std::uint64_t>::max() : hits[k].*id;
        });
    }
}

} // namespace

void OutputArray::write(const Elements& elements, const bool* flags) const {
    const auto flag = [=](std::size_t k) { return flags[k]; };
    if (scalar == Scalar::uint8) {
        store<std::uint8_t>(*this, 0, elements, flag);
    } else if (scalar == Scalar::uint32) {
        store<std::uint32_t>(*this, 0, elements, flag);
    } else {
        store<std::uint64_t>(*this, 0, elements, flag);
    }
}

void HitArrays::write(const Elements& elements, const Hit* hits, const Primitives& primitives) const {
    constexpr std::size_t together = 64; // few enough to stay at hand from one field to the next
    Vec3 normals[together];
    for (std::size_t begin = 0; begin < elements.count(); begin += together) {
        const Elements part = elements.part(begin, std::min(together, elements.count() - begin));
        write_found(part, hits + begin);
        if (!normal.wanted()) continue;
        for (std::size_t k = 0; k < part.count(); ++k) normals[k] = normal_of(hits[begin + k], primitives);
        write_normals(part, normals);
    }
}

void HitArrays::write_found(const Elements& elements, const Hit* hits) const {
    write_numbers(t, 0, elements, [=](std::size_t k) { return hits[k].t; });
    write_numbers(uv, 0, elements, [=](std::size_t k) { return hits[k].u; });
    write_numbers(uv, 1, elements, [=](std::size_t k) { return hits[k].v; });
    write_ids(instance, elements, hits, &Hit::instance);
    write_ids(geometry, elements, hits, &Hit::geometry);
    write_ids(primitive, elements, hits, &Hit::primitive);
}

void HitArrays::write_normals(const Elements& elements, const Vec3* normals) const {
    for (int axis = 0; axis < 3; ++axis)
        write_numbers(normal, axis, elements, [=](std::size_t k) { return normals[k][axis]; });
}

} // namespace raywise
