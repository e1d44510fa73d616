#include "accel/accel.h"

namespace raywise {

void Accel::closest_many(const UnpreparedRays& rays, const SurfaceHits& hits, Scratch&) const {
    for (std::size_t i = 0; i < rays.count; ++i) hits.put(i, closest(rays[i]));
}

void Accel::any_many(const UnpreparedRays& rays, bool* found, Scratch&) const {
    for (std::size_t i = 0; i < rays.count; ++i) found[i] = any(rays[i]);
}

} // namespace raywise
