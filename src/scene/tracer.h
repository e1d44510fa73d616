// Geometry with a built structure: answers rays, one or many, and counts those with a NaN.
#pragma once

#include "accel/accel.h"
#include "geometry/primitives.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace raywise {

inline constexpr std::uint32_t invalid_id = 0xFFFFFFFFu;

// An answer as the caller sees it: t in units of the caller's direction. Without a normal, which costs a square root and three corners
// that are read for nothing else: see normal_of.
struct Hit {
    double t = std::numeric_limits<double>::infinity();
    double u = 0.0;
    double v = 0.0;
    std::uint32_t instance = invalid_id;
    std::uint32_t geometry = invalid_id;
    std::uint32_t primitive = invalid_id;

    bool is_hit() const { return primitive != invalid_id; }
};

// Of the triangle that was hit, of unit length; zero for a miss.
inline Vec3 normal_of(const PrimitiveHit& hit, const Primitives& primitives) {
    return hit.is_hit() ? unit_normal(primitives.corners(hit.primitive)) : Vec3(0.0);
}

// What has been asked so far. Counted with relaxed atomics: figures for people, nothing depends on them.
struct Usage {
    std::atomic<std::uint64_t> rays{0};         // in batches
    std::atomic<std::uint64_t> batch_ns{0};     // wall time of the batches
    std::atomic<std::uint64_t> invalid_rays{0}; // rays with a NaN, single ones included
};

class Tracer {
public:
    Tracer(std::shared_ptr<const Primitives> primitives, std::shared_ptr<const Accel> accel);

    Hit closest(const Ray& ray, const Query& query = {}) const { return to_caller(ray, accel_->closest(ray, query)); }
    Hit closest(const RayF& ray, const Query& query = {}) const {
        return to_caller(ray, accel_->closest_f32(ray, query));
    }
    bool any(const Ray& ray, const Query& query = {}) const { return counted(ray, accel_->any(ray, query)); }
    bool any(const RayF& ray, const Query& query = {}) const { return counted(ray, accel_->any_f32(ray, query)); }
    // Replaces `hits` by all hits in order, each crossing of a surface once (geometry/crossings.h).
    void all(const Ray& ray, std::vector<Hit>& hits, const Query& query = {}) const;

    // The same for many rays, answer i that of ray i, as structures give it. Each returns how many of the rays hold a NaN. All hits
    // are appended ray by ray; ends[i] is how many there are with those of ray i.
    template <class AnyRay>
    std::uint64_t closest_many(const PacketOf<AnyRay>& rays, PrimitiveHit* hits, Scratch& scratch) const;
    template <class AnyRay>
    std::uint64_t any_many(const PacketOf<AnyRay>& rays, bool* found, Scratch& scratch) const;
    std::uint64_t all_many(const RayPacket& rays, std::vector<PrimitiveHit>& hits, std::size_t* ends) const;
    std::size_t rays_at_a_time() const { return accel_->rays_at_a_time(); }

    const Primitives& primitives() const { return *primitives_; }
    const std::shared_ptr<const Primitives>& shared_primitives() const { return primitives_; }
    const Accel& accel() const { return *accel_; }
    const std::shared_ptr<const Accel>& shared_accel() const { return accel_; }
    Usage& usage() const { return *usage_; }

    // What a structure answers, as the caller sees it.
    Hit to_caller(const PrimitiveHit& hit) const {
        if (!hit.is_hit()) return {};
        const PrimitiveId id = primitives_->locate(hit.primitive);
        return {hit.t, hit.u, hit.v, invalid_id, id.geometry, id.primitive};
    }

private:
    template <class AnyRay>
    Hit to_caller(const AnyRay& ray, const PrimitiveHit& hit) const {
        if (!hit.is_hit()) count_invalid(ray);
        return to_caller(hit);
    }
    template <class AnyRay>
    bool counted(const AnyRay& ray, bool found) const {
        if (!found) count_invalid(ray);
        return found;
    }

    // 1 for a ray with a NaN, which hits nothing.
    template <class AnyRay>
    std::uint64_t count_invalid(const AnyRay& ray) const {
        if (!ray.may_have_nan() || !ray.has_nan()) return 0;
        usage_->invalid_rays.fetch_add(1, std::memory_order_relaxed);
        return 1;
    }
    template <class AnyRay>
    std::uint64_t count_invalid_of(const PacketOf<AnyRay>& rays) const;

    std::shared_ptr<const Primitives> primitives_;
    std::shared_ptr<const Accel> accel_;
    std::unique_ptr<Usage> usage_;
};

} // namespace raywise
