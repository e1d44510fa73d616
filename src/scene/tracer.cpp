#include "scene/tracer.h"

#include "geometry/crossings.h"

#include <algorithm>
#include <utility>

namespace raywise {
namespace {

RayUnit unit_of(const Ray& ray) { return RayUnit(MajorAxis(ray.direction).magnitude); }

} // namespace

Tracer::Tracer(std::shared_ptr<const Primitives> primitives, std::shared_ptr<const Accel> accel)
    : primitives_(std::move(primitives)), accel_(std::move(accel)), usage_(std::make_unique<Usage>()) {}

bool Tracer::is_traceable(const Ray& ray) const {
    if (PreparedRay::is_traceable(ray)) return primitives_->hittable_count() > 0;
    if (ray.has_nan()) usage_->invalid_rays.fetch_add(1, std::memory_order_relaxed);
    return false;
}

Hit Tracer::to_caller(const RayUnit& unit, const PrimitiveHit& hit, const Corners& corners) const {
    const PrimitiveId id = primitives_->locate(hit.primitive);
    return {unit.to_caller(hit.t), hit.u, hit.v, unit_normal(corners), invalid_id, id.geometry, id.primitive};
}

Hit Tracer::closest(const Ray& ray, SkipList skip) const {
    if (!is_traceable(ray)) return {};
    const SurfaceHit hit = accel_->closest(UnpreparedRay{ray, primitives_->bounds(), skip});
    return hit.is_hit() ? to_caller(unit_of(ray), hit, hit.corners) : Hit{};
}

bool Tracer::any(const Ray& ray, SkipList skip) const {
    return is_traceable(ray) && accel_->any(UnpreparedRay{ray, primitives_->bounds(), skip});
}

Tracer::Traceable Tracer::traceable(const Ray* rays, const SkipList* skips, std::size_t count) const {
    Traceable result;
    result.rays.reserve(count);
    result.index.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_traceable(rays[i])) continue;
        result.rays.emplace_back(rays[i], primitives_->bounds(), skips[i]);
        result.index.push_back(i);
    }
    return result;
}

void Tracer::closest_many(const Ray* rays, const SkipList* skips, std::size_t count, Hit* hits) const {
    const Traceable those = traceable(rays, skips, count);
    std::vector<SurfaceHit> found(those.rays.size());
    accel_->closest_many(those.rays.data(), those.rays.size(), found.data());
    std::fill_n(hits, count, Hit{});
    for (std::size_t k = 0; k < found.size(); ++k) {
        const std::size_t i = those.index[k];
        if (found[k].is_hit()) hits[i] = to_caller(unit_of(rays[i]), found[k], found[k].corners);
    }
}

void Tracer::any_many(const Ray* rays, const SkipList* skips, std::size_t count, bool* found) const {
    const Traceable those = traceable(rays, skips, count);
    const auto answers = std::make_unique<bool[]>(those.rays.size());
    accel_->any_many(those.rays.data(), those.rays.size(), answers.get());
    std::fill_n(found, count, false);
    for (std::size_t k = 0; k < those.index.size(); ++k) found[those.index[k]] = answers[k];
}

void Tracer::all(const Ray& ray, std::vector<Hit>& hits, SkipList skip) const {
    hits.clear();
    if (!is_traceable(ray)) return;
    const PreparedRay prepared(ray, primitives_->bounds(), skip);
    std::vector<PrimitiveHit> found;
    accel_->all(prepared, found);
    std::sort(found.begin(), found.end());
    keep_crossings(prepared, *primitives_, found);
    hits.reserve(found.size());
    for (const PrimitiveHit& hit : found)
        hits.push_back(to_caller(unit_of(ray), hit, primitives_->corners(hit.primitive)));
}

} // namespace raywise
