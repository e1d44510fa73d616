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

    void read(const Elements& elements, Ray* rays) const;
};

} // namespace raywise
