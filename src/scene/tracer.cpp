#include "scene/tracer.h"

#include "geometry/crossings.h"

#include <algorithm>
#include <utility>

namespace raywise {

Tracer::Tracer(std::shared_ptr<const Primitives> primitives, std::shared_ptr<const Accel> accel)
    : primitives_(std::move(primitives)), accel_(std::move(accel)), usage_(std::make_unique<Usage>()) {}

void Tracer::count_invalid(const Ray& ray) const {
    if (ray.has_nan()) usage_->invalid_rays.fetch_add(1, std::memory_order_relaxed);
}

Hit Tracer::to_caller(const Ray& ray, const PrimitiveHit& hit, const Corners& corners) const {
    if (!hit.is_hit()) return {};
    const RayUnit unit(MajorAxis(ray.direction).magnitude);
    const PrimitiveId id = primitives_->locate(hit.primitive);
    return {unit.to_caller(hit.t), hit.u, hit.v, unit_normal(corners), invalid_id, id.geometry, id.primitive};
}

Hit Tracer::closest(const Ray& ray, SkipList skip) const {
    const SurfaceHit hit = accel_->closest(UnpreparedRay{ray, primitives_->bounds(), skip});
    if (!hit.is_hit()) count_invalid(ray);
    return to_caller(ray, hit, hit.corners);
}

bool Tracer::any(const Ray& ray, SkipList skip) const {
    if (accel_->any(UnpreparedRay{ray, primitives_->bounds(), skip})) return true;
    count_invalid(ray);
    return false;
}

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
