// The door of both grids: what they are asked goes to the kernels of Derived::traced().
#pragma once

#include "accel/accel.h"
#include "accel/collectors.h"

#include <vector>

namespace raywise {

template <class Derived>
class GridAccel : public Accel {
public:
    PrimitiveHit closest(const Ray& ray, const Query& query) const final { return trace_closest(traced(), ray, query); }
    bool any(const Ray& ray, const Query& query) const final { return trace_any(traced(), ray, query); }
    PrimitiveHit closest_f32(const RayF& ray, const Query& query) const final {
        return trace_closest(traced(), ray, query);
    }
    bool any_f32(const RayF& ray, const Query& query) const final { return trace_any(traced(), ray, query); }
    void all(const Ray& ray, const Query& query, std::vector<PrimitiveHit>& hits) const final {
        AllCollector collector(ray, query, hits);
        trace_all(traced(), ray, collector);
        collector.remove_repeats();
    }

private:
    auto traced() const { return static_cast<const Derived&>(*this).traced(); }
};

} // namespace raywise
