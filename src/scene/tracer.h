// Geometry with a built structure: answers one ray. Scenes and views both end here, which is why their answers cannot differ.
#pragma once

#include "accel/accel.h"
#include "base/ray.h"
#include "geometry/primitives.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace raywise {

inline constexpr std::uint32_t invalid_id = 0xFFFFFFFFu;

// An answer as the caller sees it: t in units of the caller's direction.
struct Hit {
    double t = std::numeric_limits<double>::infinity();
    double u = 0.0;
    double v = 0.0;
    Vec3 normal{0.0};
    std::uint32_t instance = invalid_id;
    std::uint32_t geometry = invalid_id;
    std::uint32_t primitive = invalid_id;
};

// What has been asked so far. Counted with relaxed atomics: figures for people, nothing depends on them.
struct Usage {
    std::atomic<std::uint64_t> rays{0};         // in batches
    std::atomic<std::uint64_t> batch_ns{0};     // wall time of the batches
    std::atomic<std::uint64_t> invalid_rays{0}; // rays with a NaN, single ones included
};

class Tracer {
public:
    Tracer(std::shared_ptr<const Primitives> primitives, std::shared_ptr<const Accel> accel);

    // skip: numbers of this scene's primitives.
    Hit closest(const Ray& ray, SkipList skip = {}) const;
    bool any(const Ray& ray, SkipList skip = {}) const;
    // Replaces `hits` by all hits in order, each crossing of a surface once (geometry/crossings.h).
    void all(const Ray& ray, std::vector<Hit>& hits, SkipList skip = {}) const;

    const Primitives& primitives() const { return *primitives_; }
    const std::shared_ptr<const Primitives>& shared_primitives() const { return primitives_; }
    const Accel& accel() const { return *accel_; }
    const std::shared_ptr<const Accel>& shared_accel() const { return accel_; }
    Usage& usage() const { return *usage_; }

    // What a structure answers to a ray, as the caller sees it. corners: needed for a hit only.
    Hit to_caller(const Ray& ray, const PrimitiveHit& hit, const Corners& corners) const;

private:
    void count_invalid(const Ray& ray) const;

    std::shared_ptr<const Primitives> primitives_;
    std::shared_ptr<const Accel> accel_;
    std::unique_ptr<Usage> usage_;
};

} // namespace raywise
