// The leaf test for structures whose leaves are lists of primitives: a few are told one by one, where the traversal is; the corners of more
// are gathered, and tested several at once (geometry/triangle_block-inl.h) by the best vector instructions of the processor the program
// runs on.
#pragma once

#include "accel/collectors.h"
#include "geometry/primitives.h"
#include "ray/exact_ray.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace raywise {

// As test_primitives, for any number.
bool test_gathered(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                   ClosestCollector& collector);
bool test_gathered(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                   AnyCollector& collector);
bool test_gathered(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                   AllCollector& collector);

// Fewer are not worth the call and the gathering: random rays through the bunny take a tenth less with a grid and a sixth less with a
// kd-tree where these are tested inline (AMD EPYC with AVX-512, 2026-12-01).
inline constexpr std::size_t fewest_to_gather = 3;

// Hands the hits of a ray with these primitives to the collector. Returns whether it wants no more.
template <class Collector>
bool test_primitives(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                     Collector& collector) {
    if (count >= fewest_to_gather) return test_gathered(primitives, ray, list, count, collector);
    for (std::size_t i = 0; i < count; ++i) {
        PrimitiveHit hit;
        if (primitives.test(ray, list[i], hit) && collector.collect(hit)) return true;
    }
    return false;
}

// Hands the hits of a ray with all primitives to the collector: where a structure cannot tell which it may leave out.
template <class Collector>
void test_all_primitives(const Primitives& primitives, const ExactRay& ray, Collector& collector) {
    std::array<std::uint32_t, 256> list;
    for (std::uint32_t first = 0; first < primitives.count();) {
        const std::uint32_t n = std::min(static_cast<std::uint32_t>(list.size()), primitives.count() - first);
        std::iota(list.begin(), list.begin() + n, first);
        if (test_primitives(primitives, ray, list.data(), n, collector)) return;
        first += n;
    }
}

} // namespace raywise
