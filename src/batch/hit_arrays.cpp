#include "batch/hit_arrays.h"

#include <cstring>
#include <limits>

namespace raywise {
namespace {

// value_of(k) to element first + k of one component, for each k below n. The caller's arrays need not be aligned.
template <class Value, class ValueOf>
void store(const OutputArray& array, int component, std::uint64_t first, std::size_t n, const ValueOf& value_of) {
    const std::ptrdiff_t stride = array.stride; // bytes written might be those of `array`, as far as the compiler knows
    std::byte* address = array.data + static_cast<std::ptrdiff_t>(first) * stride + component * array.component_stride;
    for (std::size_t k = 0; k < n; ++k, address += stride) {
        const auto value = static_cast<Value>(value_of(k));
        std::memcpy(address, &value, sizeof value);
    }
}

template <class ValueOf>
void write_numbers(const OutputArray& array, int component, std::uint64_t first, std::size_t n,
                   const ValueOf& value_of) {
    if (!array.wanted()) return;
    if (array.scalar == Scalar::float32) {
        store<float>(array, component, first, n, value_of);
    } else {
        store<double>(array, component, first, n, value_of);
    }
}

void write_ids(const OutputArray& array, std::uint64_t first, std::size_t n, const Hit* hits, std::uint32_t Hit::*id) {
    if (!array.wanted()) return;
    if (array.scalar == Scalar::uint32) {
        store<std::uint32_t>(array, 0, first, n, [=](std::size_t k) { return hits[k].*id; });
    } else {
        store<std::uint64_t>(array, 0, first, n, [=](std::size_t k) {
            return hits[k].*id == invalid_id ? std::numeric_limits<std::uint64_t>::max() : hits[k].*id;
        });
    }
}

} // namespace

void OutputArray::write(std::uint64_t first, std::size_t n, const bool* flags) const {
    const auto flag = [=](std::size_t k) { return flags[k]; };
    if (scalar == Scalar::uint8) {
        store<std::uint8_t>(*this, 0, first, n, flag);
    } else if (scalar == Scalar::uint32) {
        store<std::uint32_t>(*this, 0, first, n, flag);
    } else {
        store<std::uint64_t>(*this, 0, first, n, flag);
    }
}

void HitArrays::write(std::uint64_t first, std::size_t n, const Hit* hits) const {
    write_numbers(t, 0, first, n, [=](std::size_t k) { return hits[k].t; });
    write_numbers(uv, 0, first, n, [=](std::size_t k) { return hits[k].u; });
    write_numbers(uv, 1, first, n, [=](std::size_t k) { return hits[k].v; });
    for (int axis = 0; axis < 3; ++axis)
        write_numbers(normal, axis, first, n, [=](std::size_t k) { return hits[k].normal[axis]; });
    write_ids(instance, first, n, hits, &Hit::instance);
    write_ids(geometry, first, n, hits, &Hit::geometry);
    write_ids(primitive, first, n, hits, &Hit::primitive);
}

} // namespace raywise
