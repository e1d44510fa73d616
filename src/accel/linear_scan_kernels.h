// The loops of the linear scan: by the best vector instructions of the processor the program runs on (Highway's dispatch).
#pragma once

#include "accel/accel.h"
#include "accel/scene_frame.h"
#include "base/ray.h"
#include "geometry/primitives.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace raywise {

struct ScannedScene {
    const Primitives& primitives; // at least one of which can be hit
    const SceneFrame& frame;
    // All primitives in the order of their numbers (geometry/corner_lines.h), in coordinates of the frame; null: they are read from
    // the meshes.
    const float* blocks;
};

// The primitives first ... end - 1, from the lane `lane` of `blocks` on, which has NaN in the lanes behind them that a block is
// filled up with.
void gather_blocks(const Primitives& primitives, const SceneFrame& frame, std::uint32_t first, std::uint32_t end,
                   float* blocks);

// For all rays in one pass over the triangles. hits[i]: the first hit of rays[i] in the order of PrimitiveHit, or no hit.
void scan_closest(const ScannedScene& scene, const PreparedRay* rays, std::size_t count, SurfaceHit* hits);
void scan_any(const ScannedScene& scene, const PreparedRay* rays, std::size_t count, bool* found);
// Appends every hit, in the order of the primitives.
void scan_all(const ScannedScene& scene, const PreparedRay& ray, std::vector<PrimitiveHit>& hits);

} // namespace raywise
