// The rays of a batch, in the caller's arrays.
#pragma once

#include "batch/elements.h"
#include "batch/skip_arrays.h"
#include "geometry/triangle_mesh.h"
#include "ray/ray.h"

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

    // Whether all that is given is float32: such rays may be read as RayF.
    bool are_float32() const;

    // AnyRay: Ray, or RayF where they are float32.
    template <class AnyRay>
    void read(const Elements& elements, AnyRay* rays) const;
};

// body(AnyRay{}) with the type that the rays are read as without loss.
template <class Body>
auto as_read(const RayArrays& rays, const Body& body) {
    return rays.are_float32() ? body(RayF{}) : body(Ray{});
}

} // namespace raywise
