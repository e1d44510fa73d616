#include "accel/bvh_quality.h"

#include "accel/visitors.h"

namespace raywise {

// A primitive that was cut is in several leaves.
void BvhHigh::all(const PreparedRay& ray, std::vector<PrimitiveHit>& hits) const {
    const std::size_t first = hits.size();
    Bvh::all(ray, hits);
    remove_repeats(hits, first);
}

} // namespace raywise
