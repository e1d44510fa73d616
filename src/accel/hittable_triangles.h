// What builders of trees begin with: a look at each triangle that can be hit.
#pragma once

#include "accel/accel.h"
#include "base/page_array.h"
#include "geometry/mesh_cursor.h"

#include <algorithm>
#include <cstdint>
#include <functional>

namespace raywise {

// Calls body(i, primitive, mesh, triangle) for the i-th of the primitives that can be hit, on several threads. report: called with numbers of
// primitives that are done.
template <class Body>
void for_each_hittable(const BuildInput& input, const std::function<void(std::uint64_t)>& report, const Body& body) {
    constexpr std::uint64_t chunk_size = 16384; // primitives between two reports
    const Primitives& primitives = input.primitives;
    const std::uint64_t count = primitives.hittable_count();
    PageVector<std::uint32_t> hittable; // empty when all are
    if (count != primitives.count()) {
        hittable.reserve(count);
        for (std::uint32_t i = 0; i < primitives.count(); ++i) {
            if (primitives.is_hittable(i)) hittable.push_back(i);
        }
    }
    input.parallel.for_each((count + chunk_size - 1) / chunk_size, [&](std::uint64_t chunk) {
        const std::uint64_t begin = chunk * chunk_size;
        const std::uint64_t end = std::min(count, begin + chunk_size);
        MeshCursor cursor(primitives);
        for (std::uint64_t i = begin; i < end; ++i) {
            const std::uint32_t primitive = hittable.empty() ? static_cast<std::uint32_t>(i) : hittable[i];
            cursor.move_to(primitive);
            body(i, primitive, cursor.mesh(), cursor.triangle(primitive));
        }
        report(end - begin);
    });
}

} // namespace raywise
