#include "scene/tracer.h"

#include "geometry/crossings.h"

#include <algorithm>
#include <utility>

namespace raywise {
namespace {

void closest_of(const Accel& accel, const RayPacket& rays, PrimitiveHit* hits, Scratch& scratch) {
    accel.closest_many(rays, hits, scratch);
}
void closest_of(const Accel& accel, const RayPacketF& rays, PrimitiveHit* hits, Scratch& scratch) {
    accel.closest_many_f32(rays, hits, scratch);
}
void any_of(const Accel& accel, const RayPacket& rays, bool* found, Scratch& scratch) {
    accel.any_many(rays, found, scratch);
}
void any_of(const Accel& accel, const RayPacketF& rays, bool* found, Scratch& scratch) {
    accel.any_many_f32(rays, found, scratch);
}

} // namespace

Tracer::Tracer(std::shared_ptr<const Primitives> primitives, std::shared_ptr<const Accel> accel)
    : primitives_(std::move(primitives)), accel_(std::move(accel)), usage_(std::make_unique<Usage>()) {}

// Before they are traced, while they are in the first caches; and of all of them, as whether a ray hit anything is a branch that nobody
// can predict. One branch for all: nearly always none has a NaN.
template <class AnyRay>
std::uint64_t Tracer::count_invalid_of(const PacketOf<AnyRay>& rays) const {
    bool may_have_nan = false;
    for (std::size_t i = 0; i < rays.count; ++i) may_have_nan |= rays.rays[i].may_have_nan();
    std::uint64_t invalid = 0;
    if (may_have_nan) {
        for (std::size_t i = 0; i < rays.count; ++i) invalid += count_invalid(rays.rays[i]);
    }
    return invalid;
}

template <class AnyRay>
std::uint64_t Tracer::closest_many(const PacketOf<AnyRay>& rays, PrimitiveHit* hits, Scratch& scratch) const {
    const std::uint64_t invalid = count_invalid_of(rays);
    closest_of(*accel_, rays, hits, scratch);
    return invalid;
}
template std::uint64_t Tracer::closest_many(const RayPacket&, PrimitiveHit*, Scratch&) const;
template std::uint64_t Tracer::closest_many(const RayPacketF&, PrimitiveHit*, Scratch&) const;

template <class AnyRay>
std::uint64_t Tracer::any_many(const PacketOf<AnyRay>& rays, bool* found, Scratch& scratch) const {
    const std::uint64_t invalid = count_invalid_of(rays);
    any_of(*accel_, rays, found, scratch);
    return invalid;
}
template std::uint64_t Tracer::any_many(const RayPacket&, bool*, Scratch&) const;
template std::uint64_t Tracer::any_many(const RayPacketF&, bool*, Scratch&) const;

std::uint64_t Tracer::all_many(const RayPacket& rays, std::vector<PrimitiveHit>& hits, std::size_t* ends) const {
    const std::uint64_t invalid = count_invalid_of(rays);
    for (std::size_t i = 0; i < rays.count; ++i) {
        const Ray& ray = rays.rays[i];
        const std::size_t first = hits.size();
        accel_->all(ray, rays.query(i), hits);
        if (hits.size() > first) {
            std::sort(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end());
            keep_crossings(ExactRay(ray), *primitives_, hits, first);
        }
        ends[i] = hits.size();
    }
    return invalid;
}

void Tracer::all(const Ray& ray, std::vector<Hit>& hits, const Query& query) const {
    std::vector<PrimitiveHit> found;
    std::size_t end = 0;
    all_many({&ray, &query, 1}, found, &end);
    hits.clear();
    hits.reserve(found.size());
    for (const PrimitiveHit& hit : found) hits.push_back(to_caller(hit));
}

} // namespace raywise
