// What becomes of the hits that leaves report, for each of the three questions: once for all structures.
//
// A structure calls collect() for hits within the ray's interval, in any order and any number of times each, and stops as soon as it
// returns true. It may leave out whatever lies beyond limit(), a t of the caller's.
#pragma once

#include "accel/accel.h"
#include "base/scratch.h"
#include "geometry/primitives.h"
#include "ray/query.h"
#include "ray/ray.h"

#include <algorithm>
#include <cstddef>
#include <new>
#include <vector>

namespace raywise {

class ClosestCollector {
public:
    static constexpr bool wants_nearest_first = true;

    template <class AnyRay>
    ClosestCollector(const AnyRay& ray, const Query& query) : query_(&query), limit_(ray.tmax) {}

    bool collect(const PrimitiveHit& hit) {
        if (hit < best_ && !query_->passes_through(hit.primitive)) {
            best_.t = limit_ = hit.t;
            best_.u = hit.u;
            best_.v = hit.v;
            best_.primitive = hit.primitive;
        }
        return false;
    }
    double limit() const { return limit_; }
    // Member by member, as above: a copy by whole registers would wait for the stores of eight bytes (a store-forwarding stall).
    PrimitiveHit best() const { return {best_.t, best_.u, best_.v, best_.primitive}; }

private:
    const Query* query_;
    PrimitiveHit best_;
    double limit_;
};

class AnyCollector {
public:
    static constexpr bool wants_nearest_first = false;

    template <class AnyRay>
    AnyCollector(const AnyRay& ray, const Query& query) : query_(&query), limit_(ray.tmax) {}

    bool collect(const PrimitiveHit& hit) {
        found_ = !query_->passes_through(hit.primitive);
        return found_;
    }
    double limit() const { return limit_; }
    bool found() const { return found_; }

private:
    const Query* query_;
    double limit_;
    bool found_ = false;
};

class AllCollector {
public:
    static constexpr bool wants_nearest_first = false;

    AllCollector(const Ray& ray, const Query& query, std::vector<PrimitiveHit>& hits)
        : query_(&query), hits_(&hits), first_(hits.size()), limit_(ray.tmax) {}

    bool collect(const PrimitiveHit& hit) {
        if (!query_->passes_through(hit.primitive)) hits_->push_back(hit);
        return false;
    }
    double limit() const { return limit_; }

    // For structures that meet a primitive in several places.
    void remove_repeats() {
        const auto begin = hits_->begin() + static_cast<std::ptrdiff_t>(first_);
        std::sort(begin, hits_->end());
        const auto same = [](const PrimitiveHit& a, const PrimitiveHit& b) { return a.primitive == b.primitive; };
        hits_->erase(std::unique(begin, hits_->end(), same), hits_->end());
    }

private:
    const Query* query_;
    std::vector<PrimitiveHit>* hits_;
    std::size_t first_;
    double limit_;
};

// A collector for each of many rays, in scratch memory.
template <class Collector>
class Collectors {
public:
    template <class AnyRay>
    Collectors(const PacketOf<AnyRay>& rays, Scratch& scratch) : collectors_(scratch.take<Collector>(rays.count)) {
        static constexpr Query none{};
        for (std::size_t i = 0; i < rays.count; ++i)
            new (collectors_ + i) Collector(rays.rays[i], rays.queries != nullptr ? rays.queries[i] : none);
    }

    Collector* data() const { return collectors_; }
    const Collector& operator[](std::size_t i) const { return collectors_[i]; }

private:
    Collector* const collectors_;
};

} // namespace raywise
