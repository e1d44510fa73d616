#include "scene/tracer.h"

#include "geometry/crossings.h"

#include <algorithm>
#include <utility>

namespace raywise {

Tracer::Tracer(std::shared_ptr<const Primitives> primitives, std::shared_ptr<const Accel> accel)
    : primitives_(std::move(primitives)), accel_(std::move(accel)), usage_(std::make_unique<Usage>()) {}

void Tracer::all(const Ray& ray, std::vector<Hit>& hits, const Query& query) const {
    hits.clear();
    if (!ray.is_traceable()) {
        count_invalid(ray);
        return;
    }
    std::vector<PrimitiveHit> found;
    accel_->all(ray, query, found);
    std::sort(found.begin(), found.end());
    keep_crossings(ExactRay(ray), *primitives_, found);
    hits.reserve(found.size());
    for (const PrimitiveHit& hit : found) hits.push_back(to_caller(hit));
}

} // namespace raywise
