// The leaf test for structures whose leaves are lists of primitives: their corners are gathered, and tested several at once
// (geometry/triangle_block-inl.h), by the best vector instructions of the processor the program runs on.
#pragma once

#include "accel/collectors.h"
#include "geometry/primitives.h"
#include "ray/exact_ray.h"

#include <cstdint>

namespace raywise {

// Hands the hits of a ray with these primitives to the collector. Returns whether it wants no more.
bool test_primitives(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                     ClosestCollector& collector);
bool test_primitives(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                     AnyCollector& collector);
bool test_primitives(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                     AllCollector& collector);

} // namespace raywise
