// The three questions as visitors, so that each structure writes its traversal once.
//
// A structure derives from TraversedAccel<Itself> and has
//     template <class Visitor> void traverse(const PreparedRay& ray, Visitor& visitor) const;
// which calls visitor.visit(primitive) for primitives the ray may hit, any number of times each, stops as soon as visit
// returns true, and may skip whatever lies beyond visitor.limit() (scaled t; leave the ray's margin).
#pragma once

#include "accel/accel.h"

#include <algorithm>

namespace raywise {

class ClosestVisitor {
public:
    ClosestVisitor(const Primitives& primitives, const PreparedRay& ray)
        : primitives_(primitives), ray_(ray), limit_(ray.tmax) {}

    bool visit(std::uint32_t primitive) {
        PrimitiveHit hit;
        if (primitives_.test(ray_, primitive, hit) && hit < best_) {
            best_ = hit;
            limit_ = hit.t;
        }
        return false;
    }
    double limit() const { return limit_; }
    const PrimitiveHit& best() const { return best_; }

private:
    const Primitives& primitives_;
    const PreparedRay& ray_;
    PrimitiveHit best_;
    double limit_;
};

class AnyVisitor {
public:
    AnyVisitor(const Primitives& primitives, const PreparedRay& ray) : primitives_(primitives), ray_(ray) {}

    bool visit(std::uint32_t primitive) {
        PrimitiveHit hit;
        found_ = primitives_.test(ray_, primitive, hit);
        return found_;
    }
    double limit() const { return ray_.tmax; }
    bool found() const { return found_; }

private:
    const Primitives& primitives_;
    const PreparedRay& ray_;
    bool found_ = false;
};

// Of the hits from `first` on, as structures collect them that meet a primitive in several places.
inline void remove_repeats(std::vector<PrimitiveHit>& hits, std::size_t first) {
    const auto begin = hits.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, hits.end());
    const auto same = [](const PrimitiveHit& a, const PrimitiveHit& b) { return a.primitive == b.primitive; };
    hits.erase(std::unique(begin, hits.end(), same), hits.end());
}

class AllVisitor {
public:
    AllVisitor(const Primitives& primitives, const PreparedRay& ray, std::vector<PrimitiveHit>& hits)
        : primitives_(primitives), ray_(ray), hits_(hits), first_(hits.size()) {}

    bool visit(std::uint32_t primitive) {
        PrimitiveHit hit;
        if (primitives_.test(ray_, primitive, hit)) hits_.push_back(hit);
        return false;
    }
    double limit() const { return ray_.tmax; }

    // Structures that split space meet a primitive in several cells.
    void remove_repeats() { raywise::remove_repeats(hits_, first_); }

private:
    const Primitives& primitives_;
    const PreparedRay& ray_;
    std::vector<PrimitiveHit>& hits_;
    std::size_t first_;
};

template <class Derived>
class TraversedAccel : public Accel {
public:
    explicit TraversedAccel(const Primitives& primitives) : primitives_(primitives) {}

    using Accel::any;
    using Accel::closest;

    SurfaceHit closest(const PreparedRay& ray) const final {
        ClosestVisitor visitor(primitives_, ray);
        derived().traverse(ray, visitor);
        SurfaceHit hit{visitor.best(), {}};
        if (hit.is_hit()) hit.corners = primitives_.corners(hit.primitive);
        return hit;
    }
    bool any(const PreparedRay& ray) const final {
        AnyVisitor visitor(primitives_, ray);
        derived().traverse(ray, visitor);
        return visitor.found();
    }
    void all(const PreparedRay& ray, std::vector<PrimitiveHit>& hits) const final {
        AllVisitor visitor(primitives_, ray, hits);
        derived().traverse(ray, visitor);
        visitor.remove_repeats();
    }

protected:
    const Primitives& primitives() const { return primitives_; }

private:
    const Derived& derived() const { return static_cast<const Derived&>(*this); }

    const Primitives& primitives_;
};

} // namespace raywise
