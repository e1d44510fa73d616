#include "scene/tracer.h"

#include "geometry/crossings.h"

#include <algorithm>
#include <utility>

namespace raywise {

Tracer::Tracer(std::shared_ptr<const Primitives> primitives, std::shared_ptr<const Accel> accel)
    : primitives_(std::move(primitives)), accel_(std::move(accel)), usage_(std::make_unique<Usage>()) {}

void Tracer::all(const Ray& ray, std::vector<Hit>& hits, SkipList skip) const {
    hits.clear();
    if (!PreparedRay::is_traceable(ray)) {
        count_invalid(ray);
        return;
    }
    const PreparedRay prepared(ray, primitives_->bounds(), skip);
    std::vector<PrimitiveHit> found;
    accel_->all(prepared, found);
    std::sort(found.begin(), found.end());
    keep_crossings(prepared, *primitives_, found);
    hits.reserve(found.size());
    for (const PrimitiveHit& hit : found) hits.push_back(to_caller(ray, hit, primitives_->corners(hit.primitive)));
}

} // namespace raywise
