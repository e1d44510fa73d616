// Many rays over the caller's arrays, on several threads. The answers are those of Tracer, ray by ray.
#pragma once

#include "base/parallel.h"
#include "batch/skip_arrays.h"
#include "geometry/triangle_mesh.h"
#include "scene/tracer.h"

#include <cstddef>
#include <cstdint>

namespace raywise {

struct RayArrays {
    std::uint64_t count = 0;
    StridedArray origin;
    StridedArray direction;
    StridedArray tmin; // data null: 0
    StridedArray tmax; // data null: infinity
    SkipArrays skip;

    Ray ray(std::uint64_t i) const;
};

// The caller's memory for one field of the answers. data null: not wanted.
struct OutputArray {
    std::byte* data = nullptr;
    std::ptrdiff_t stride = 0;
    std::ptrdiff_t component_stride = 0;
    Scalar scalar = Scalar::float32;

    bool wanted() const { return data != nullptr; }
    void put_number(std::uint64_t element, int component, double value) const; // float32 or float64, rounded
    void put_integer(std::uint64_t element, std::uint64_t value) const;        // uint8, uint32 or uint64
    void put_id(std::uint64_t element, std::uint32_t id) const;                // invalid_id fills all bits
};

struct HitArrays {
    OutputArray t;
    OutputArray uv;
    OutputArray normal;
    OutputArray instance;
    OutputArray geometry;
    OutputArray primitive;

    void put(std::uint64_t element, const Hit& hit) const;
};

// Each returns how many of the rays held a NaN. The skip lists have to be checked.
std::uint64_t intersect_batch(const Tracer& tracer, const RayArrays& rays, const HitArrays& hits,
                              const Parallel& parallel);
std::uint64_t occluded_batch(const Tracer& tracer, const RayArrays& rays, const OutputArray& occluded,
                             const Parallel& parallel);

// Writes rays.count + 1 offsets, and the hits when they fit the capacity. Returns through `needed` how many there are.
std::uint64_t intersect_all_batch(const Tracer& tracer, const RayArrays& rays, std::uint64_t* offsets,
                                  const HitArrays& hits, std::uint64_t capacity, std::uint64_t& needed,
                                  const Parallel& parallel);

} // namespace raywise
