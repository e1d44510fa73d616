#include "batch/hit_arrays.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace raywise {
namespace {

// value_of(k) to one component of elements[k], for each k. The caller's arrays need not be aligned.
template <class Value, class ValueOf>
void store(const OutputArray& array, int component, const Elements& elements, const ValueOf& value_of) {
    std::byte* const data = array.data + component * array.component_stride;
    elements.for_each_offset(array.stride, [&](std::size_t k, std::ptrdiff_t offset) {
        const auto value = static_cast<Value>(value_of(k));
        std::memcpy(data + offset, &value, sizeof value);
    });
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

// id_of(k): invalid_id for a miss.
template <class IdOf>
void write_ids(const OutputArray& array, const Elements& elements, const IdOf& id_of) {
    if (!array.wanted()) return;
    if (array.scalar == Scalar::uint32) {
        store<std::uint32_t>(array, 0, elements, id_of);
    } else {
        store<std::uint64_t>(array, 0, elements, [&](std::size_t k) {
            const std::uint32_t id = id_of(k);
            return id == invalid_id ? std::numeric_limits<std::uint64_t>::max() : id;
        });
    }
}

// In parts of so many, few enough to stay in the first-level cache from one component to the next. What lies all over the caller's memory is
// asked for before it is needed: the indices of a triangle two parts ahead, the vertices that they name one.
void write_normals(const OutputArray& array, const Elements& elements, const PrimitiveHit* hits,
                   const Primitives& primitives) {
    if (!array.wanted()) return;
    constexpr std::size_t together = 64;
    const std::size_t count = elements.count();
    const auto for_hits = [&](std::size_t begin, const auto& ask) {
        for (std::size_t k = begin; k < std::min(begin + together, count); ++k) {
            if (hits[k].is_hit()) ask(hits[k].primitive);
        }
    };
    const auto ask_for_indices = [&](std::uint32_t hit) { primitives.prefetch_indices(hit); };
    const auto ask_for_vertices = [&](std::uint32_t hit) { primitives.prefetch_vertices(hit); };
    for_hits(0, ask_for_indices);
    for_hits(together, ask_for_indices);
    for_hits(0, ask_for_vertices);
    Vec3 normals[together];
    for (std::size_t begin = 0; begin < count; begin += together) {
        const Elements part = elements.part(begin, std::min(together, count - begin));
        for_hits(begin + 2 * together, ask_for_indices);
        for_hits(begin + together, ask_for_vertices);
        for (std::size_t k = 0; k < part.count(); ++k) normals[k] = normal_of(hits[begin + k], primitives);
        for (int axis = 0; axis < 3; ++axis)
            write_numbers(array, axis, part, [&](std::size_t k) { return normals[k][axis]; });
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

void OutputArray::prefetch(const Elements& elements) const {
    if (!wanted() || !elements.are_scattered()) return; // those that follow each other the processor sees coming
    std::byte* const memory = data;
    elements.for_each_offset(stride,
                             [=](std::size_t, std::ptrdiff_t offset) { __builtin_prefetch(memory + offset, 1); });
}

void HitArrays::write(const Elements& elements, const PrimitiveHit* hits, const Primitives& primitives) const {
    write_numbers(t, 0, elements, [=](std::size_t k) { return hits[k].t; });
    write_numbers(uv, 0, elements, [=](std::size_t k) { return hits[k].u; });
    write_numbers(uv, 1, elements, [=](std::size_t k) { return hits[k].v; });
    write_ids(instance, elements, [](std::size_t) { return invalid_id; });
    const bool is_one_mesh = primitives.meshes().size() == 1;
    const auto located = [&](std::size_t k) {
        return hits[k].is_hit() ? primitives.locate(hits[k].primitive) : PrimitiveId{invalid_id, invalid_id};
    };
    write_ids(geometry, elements, [&](std::size_t k) { return located(k).geometry; });
    static_assert(PrimitiveHit::no_primitive == invalid_id);
    if (is_one_mesh) { // where numbers are ids
        write_ids(primitive, elements, [=](std::size_t k) { return hits[k].primitive; });
    } else {
        write_ids(primitive, elements, [&](std::size_t k) { return located(k).primitive; });
    }
    write_normals(normal, elements, hits, primitives);
}

} // namespace raywise
