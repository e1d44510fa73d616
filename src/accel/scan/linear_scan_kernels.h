// The loops of the linear scan: by the best vector instructions of the processor the program runs on (Highway's dispatch).
#pragma once

#include "accel/accel.h"
#include "accel/collectors.h"
#include "geometry/primitives.h"
#include "ray/scene_frame.h"

#include <cstddef>
#include <cstdint>

namespace raywise {

// Of no more primitives each is tested for itself where there are no blocks. That asks for no frame.
inline constexpr std::uint32_t most_tested_singly = 16;

struct ScannedScene {
    const Primitives& primitives;
    const SceneFrame& frame;
    // All primitives in the order of their numbers (geometry/corner_lines.h), in coordinates of the frame; null: they are read from
    // the meshes.
    const float* blocks;
};

// Whether so many rays at a time are scanned by outcodes (outcodes-inl.h), with the mesh read in place, rather than triangle by triangle. For
// many its triangles have to share their vertices; one is quicker so in any case, but for vertices that only other meshes use.
bool suits_outcodes(const TriangleMesh& mesh, std::size_t rays);
// ... many rays through each mesh.
bool suit_outcodes(const Primitives& primitives);

// The primitives first ... end - 1, from the lane `lane` of `blocks` on, which has NaN in the lanes behind them that a block is
// filled up with.
void gather_blocks(const Primitives& primitives, const SceneFrame& frame, std::uint32_t first, std::uint32_t end,
                   float* blocks);

// For all rays in one pass over the triangles; collectors: of each ray. Rays that are not traceable hit nothing.
void scan_closest(const ScannedScene& scene, const Ray* rays, std::size_t count, ClosestCollector* collectors);
void scan_any(const ScannedScene& scene, const Ray* rays, std::size_t count, AnyCollector* collectors);
void scan_all(const ScannedScene& scene, const Ray& ray, AllCollector& collector);

} // namespace raywise
