// The answers of a batch, in the caller's arrays.
#pragma once

#include "batch/elements.h"
#include "geometry/triangle_mesh.h"
#include "scene/tracer.h"

#include <cstddef>
#include <cstdint>

namespace raywise {

// The caller's memory for one field of the answers. data null: not wanted.
struct OutputArray {
    std::byte* data = nullptr;
    std::ptrdiff_t stride = 0;
    std::ptrdiff_t component_stride = 0;
    Scalar scalar = Scalar::float32;

    bool wanted() const { return data != nullptr; }
    // As uint8, uint32 or uint64: 1 for true, 0 for false.
    void write(const Elements& elements, const bool* flags) const;
    // Asks for the memory of these elements, which are written soon.
    void prefetch(const Elements& elements) const;
};

struct HitArrays {
    OutputArray t;        // numbers: float32 or float64, rounded
    OutputArray uv;       // two
    OutputArray normal;   // three; only where it is wanted are normals computed
    OutputArray instance; // ids: uint32 or uint64; no id has all bits set
    OutputArray geometry;
    OutputArray primitive;

    // All fields that are wanted.
    void write(const Elements& elements, const PrimitiveHit* hits, const Primitives& primitives) const;
};

} // namespace raywise
