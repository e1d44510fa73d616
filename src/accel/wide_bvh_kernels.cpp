#include "accel/wide_bvh_kernels.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/wide_bvh_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/wide_traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

class ClosestSink {
public:
    static constexpr bool in_order = true;

    ClosestSink(const PreparedRay& ray, const FrameRay& frame_ray, SurfaceHit& best)
        : ray_(ray), frame_ray_(frame_ray), best_(best), last_(frame_ray.last(ray.tmax)) {}

    HWY_INLINE bool test(const Corners& corners, std::uint32_t primitive) {
        PrimitiveHit hit;
        if (Primitives::test_corners(ray_, corners, primitive, hit) && hit < best_) {
            best_ = {hit, corners};
            last_ = frame_ray_.last(hit.t);
        }
        return false;
    }
    float last() const { return last_; }

private:
    const PreparedRay& ray_;
    const FrameRay& frame_ray_;
    SurfaceHit& best_;
    float last_;
};

class AnySink {
public:
    static constexpr bool in_order = false;

    AnySink(const PreparedRay& ray, const FrameRay& frame_ray) : ray_(ray), last_(frame_ray.last(ray.tmax)) {}

    HWY_INLINE bool test(const Corners& corners, std::uint32_t primitive) {
        PrimitiveHit hit;
        return Primitives::test_corners(ray_, corners, primitive, hit);
    }
    float last() const { return last_; }

private:
    const PreparedRay& ray_;
    float last_;
};

class AllSink {
public:
    static constexpr bool in_order = false;

    AllSink(const PreparedRay& ray, const FrameRay& frame_ray, std::vector<PrimitiveHit>& hits)
        : ray_(ray), hits_(hits), last_(frame_ray.last(ray.tmax)) {}

    bool test(const Corners& corners, std::uint32_t primitive) {
        PrimitiveHit hit;
        if (Primitives::test_corners(ray_, corners, primitive, hit)) hits_.push_back(hit);
        return false;
    }
    float last() const { return last_; }

private:
    const PreparedRay& ray_;
    std::vector<PrimitiveHit>& hits_;
    float last_;
};

SurfaceHit closest_hit_kernel(const WideBvhQuery& query) {
    SurfaceHit best;
    const FrameRay frame_ray(query.ray, query.bvh.frame);
    if (frame_ray.misses()) return best;
    ClosestSink sink(query.ray, frame_ray, best);
    traverse(query, frame_ray, sink);
    return best;
}

bool any_hit_kernel(const WideBvhQuery& query) {
    const FrameRay frame_ray(query.ray, query.bvh.frame);
    if (frame_ray.misses()) return false;
    AnySink sink(query.ray, frame_ray);
    return traverse(query, frame_ray, sink);
}

void all_hits_kernel(const WideBvhQuery& query, std::vector<PrimitiveHit>& hits) {
    const FrameRay frame_ray(query.ray, query.bvh.frame);
    if (frame_ray.misses()) return;
    AllSink sink(query.ray, frame_ray, hits);
    traverse(query, frame_ray, sink);
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(closest_hit_kernel);
HWY_EXPORT(any_hit_kernel);
HWY_EXPORT(all_hits_kernel);

SurfaceHit closest_hit(const WideBvhQuery& query) { return HWY_DYNAMIC_DISPATCH(closest_hit_kernel)(query); }
bool any_hit(const WideBvhQuery& query) { return HWY_DYNAMIC_DISPATCH(any_hit_kernel)(query); }
void all_hits(const WideBvhQuery& query, std::vector<PrimitiveHit>& hits) {
    HWY_DYNAMIC_DISPATCH(all_hits_kernel)(query, hits);
}

} // namespace raywise
#endif
