// How a ray walks through a WideBvh: by the best vector instructions of the processor the program runs on (Highway's dispatch).
#pragma once

#include "accel/wide_bvh.h"
#include "base/ray.h"
#include "geometry/primitives.h"

#include <vector>

namespace raywise {

struct WideBvhQuery {
    const WideBvh& bvh;
    const Primitives& primitives; // that it was built from
    const PreparedRay& ray;
};

// The first hit in the order of PrimitiveHit, or no hit.
SurfaceHit closest_hit(const WideBvhQuery& query);
bool any_hit(const WideBvhQuery& query);
// Appends every hit; one on a primitive with several references once for each.
void all_hits(const WideBvhQuery& query, std::vector<PrimitiveHit>& hits);

} // namespace raywise
