// How a ray walks through a WideBvh: by the best vector instructions of the processor the program runs on (Highway's dispatch).
#pragma once

#include "accel/accel.h"
#include "accel/wide_bvh.h"
#include "base/ray.h"
#include "geometry/primitives.h"

#include <vector>

namespace raywise {

struct WideBvhScene {
    const WideBvh& bvh;
    const Primitives& primitives; // that it was built from
};

// As the functions of Accel.
SurfaceHit closest_hit(const WideBvhScene& scene, const PreparedRay& ray);
SurfaceHit closest_hit(const WideBvhScene& scene, const UnpreparedRay& ray);
void closest_hits(const WideBvhScene& scene, const UnpreparedRays& rays, const SurfaceHits& hits, Scratch& scratch);
bool any_hit(const WideBvhScene& scene, const PreparedRay& ray);
bool any_hit(const WideBvhScene& scene, const UnpreparedRay& ray);
void any_hits(const WideBvhScene& scene, const UnpreparedRays& rays, bool* found, Scratch& scratch);
// Appends every hit; one on a primitive with several references once for each.
void all_hits(const WideBvhScene& scene, const PreparedRay& ray, std::vector<PrimitiveHit>& hits);

} // namespace raywise
