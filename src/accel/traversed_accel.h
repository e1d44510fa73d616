// The three questions for structures that write their traversal once.
//
// A structure derives from TraversedAccel<Itself> and has
//     template <class Collector> void traverse(const ExactRay& ray, Collector& collector) const;
// which hands the primitives that the ray may hit to test_primitives, until that returns true.
#pragma once

#include "accel/accel.h"
#include "accel/collectors.h"
#include "accel/primitive_test.h"

#include <vector>

namespace raywise {

template <class Derived>
class TraversedAccel : public Accel {
public:
    explicit TraversedAccel(const Primitives& primitives) : primitives_(primitives) {}

    PrimitiveHit closest(const Ray& ray, const Query& query) const final {
        ClosestCollector collector(ray, query);
        if (ray.is_traceable()) derived().traverse(ExactRay(ray), collector);
        return collector.best();
    }
    bool any(const Ray& ray, const Query& query) const final {
        AnyCollector collector(ray, query);
        if (ray.is_traceable()) derived().traverse(ExactRay(ray), collector);
        return collector.found();
    }
    void all(const Ray& ray, const Query& query, std::vector<PrimitiveHit>& hits) const final {
        AllCollector collector(ray, query, hits);
        if (ray.is_traceable()) derived().traverse(ExactRay(ray), collector);
        collector.remove_repeats();
    }

protected:
    const Primitives& primitives() const { return primitives_; }

private:
    const Derived& derived() const { return static_cast<const Derived&>(*this); }

    const Primitives& primitives_;
};

} // namespace raywise
