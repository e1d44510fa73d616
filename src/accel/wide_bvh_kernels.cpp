#include "accel/wide_bvh_kernels.h"

#include <optional>

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/wide_bvh_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/frame_ray-inl.h"
#include "accel/wide_traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

// A ray that is prepared when a triangle has to be tested exactly, which half of all rays never come to.
class LazyRay {
public:
    explicit LazyRay(const PreparedRay& ray) : prepared_(&ray) {}
    explicit LazyRay(const UnpreparedRay& ray) : unprepared_(&ray) {}

    HWY_INLINE const PreparedRay& prepared() {
        if (prepared_ == nullptr)
            prepared_ = &storage_.emplace(unprepared_->ray, unprepared_->bounds, unprepared_->skip);
        return *prepared_;
    }

private:
    const UnpreparedRay* unprepared_ = nullptr;
    const PreparedRay* prepared_ = nullptr;
    std::optional<PreparedRay> storage_;
};

// What all three questions ask of a triangle that may be hit.
class ExactTest {
public:
    template <class AnyRay>
    ExactTest(const WideBvhScene& scene, const AnyRay& ray) : scene_(scene), ray_(ray) {}

    HWY_INLINE bool operator()(const BlockTriangle& triangle, PrimitiveHit& hit) {
        return Primitives::test_corners(ray_.prepared(), corners(triangle), triangle.primitive(), hit);
    }
    HWY_INLINE Corners corners(const BlockTriangle& triangle) const {
        return scene_.bvh.exact ? triangle.corners(scene_.bvh.frame) : scene_.primitives.corners(triangle.primitive());
    }

private:
    const WideBvhScene& scene_;
    LazyRay ray_;
};

class ClosestSink {
public:
    static constexpr bool in_order = true;

    template <class AnyRay>
    ClosestSink(const WideBvhScene& scene, const AnyRay& ray, const FrameRay& frame_ray, SurfaceHit& best)
        : test_(scene, ray), frame_ray_(frame_ray), best_(best), last_(frame_ray.last_of_ray) {}

    HWY_INLINE bool test(const BlockTriangle& triangle) {
        PrimitiveHit hit;
        if (test_(triangle, hit) && hit < best_) {
            best_.t = hit.t; // member by member: a copy of what was just written would take long
            best_.u = hit.u;
            best_.v = hit.v;
            best_.primitive = hit.primitive;
            triangle_ = triangle;
            last_ = frame_ray_.last(hit.t);
        }
        return false;
    }
    float last() const { return last_; }
    void add_corners() {
        if (best_.is_hit()) best_.corners = test_.corners(triangle_);
    }

private:
    ExactTest test_;
    const FrameRay& frame_ray_;
    SurfaceHit& best_;
    BlockTriangle triangle_;
    float last_;
};

class AnySink {
public:
    static constexpr bool in_order = false;

    template <class AnyRay>
    AnySink(const WideBvhScene& scene, const AnyRay& ray, float last) : test_(scene, ray), last_(last) {}

    HWY_INLINE bool test(const BlockTriangle& triangle) {
        PrimitiveHit hit;
        return test_(triangle, hit);
    }
    float last() const { return last_; }

private:
    ExactTest test_;
    float last_;
};

class AllSink {
public:
    static constexpr bool in_order = false;

    AllSink(const WideBvhScene& scene, const PreparedRay& ray, float last, std::vector<PrimitiveHit>& hits)
        : test_(scene, ray), hits_(hits), last_(last) {}

    bool test(const BlockTriangle& triangle) {
        PrimitiveHit hit;
        if (test_(triangle, hit)) hits_.push_back(hit);
        return false;
    }
    float last() const { return last_; }

private:
    ExactTest test_;
    std::vector<PrimitiveHit>& hits_;
    float last_;
};

template <class AnyRay>
HWY_INLINE SurfaceHit closest_of(const WideBvhScene& scene, const AnyRay& ray) {
    SurfaceHit best;
    if (scene.bvh.nodes.empty()) return best;
    FrameRay frame_ray;
    set_frame_ray(ray, scene.bvh.frame, frame_ray);
    if (frame_ray.misses()) return best;
    ClosestSink sink(scene, ray, frame_ray, best);
    traverse(scene.bvh, frame_ray, sink);
    sink.add_corners();
    return best;
}

template <class AnyRay>
HWY_INLINE bool any_of(const WideBvhScene& scene, const AnyRay& ray) {
    if (scene.bvh.nodes.empty()) return false;
    FrameRay frame_ray;
    set_frame_ray(ray, scene.bvh.frame, frame_ray);
    if (frame_ray.misses()) return false;
    AnySink sink(scene, ray, frame_ray.last_of_ray);
    return traverse(scene.bvh, frame_ray, sink);
}

SurfaceHit closest_prepared(const WideBvhScene& scene, const PreparedRay& ray) { return closest_of(scene, ray); }
SurfaceHit closest_unprepared(const WideBvhScene& scene, const UnpreparedRay& ray) { return closest_of(scene, ray); }
bool any_prepared(const WideBvhScene& scene, const PreparedRay& ray) { return any_of(scene, ray); }
bool any_unprepared(const WideBvhScene& scene, const UnpreparedRay& ray) { return any_of(scene, ray); }

void all_prepared(const WideBvhScene& scene, const PreparedRay& ray, std::vector<PrimitiveHit>& hits) {
    if (scene.bvh.nodes.empty()) return;
    const FrameRay frame_ray(ray, scene.bvh.frame);
    if (frame_ray.misses()) return;
    AllSink sink(scene, ray, frame_ray.last_of_ray, hits);
    traverse(scene.bvh, frame_ray, sink);
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(closest_prepared);
HWY_EXPORT(closest_unprepared);
HWY_EXPORT(any_prepared);
HWY_EXPORT(any_unprepared);
HWY_EXPORT(all_prepared);

SurfaceHit closest_hit(const WideBvhScene& scene, const PreparedRay& ray) {
    return HWY_DYNAMIC_DISPATCH(closest_prepared)(scene, ray);
}
SurfaceHit closest_hit(const WideBvhScene& scene, const UnpreparedRay& ray) {
    return HWY_DYNAMIC_DISPATCH(closest_unprepared)(scene, ray);
}
bool any_hit(const WideBvhScene& scene, const PreparedRay& ray) {
    return HWY_DYNAMIC_DISPATCH(any_prepared)(scene, ray);
}
bool any_hit(const WideBvhScene& scene, const UnpreparedRay& ray) {
    return HWY_DYNAMIC_DISPATCH(any_unprepared)(scene, ray);
}
void all_hits(const WideBvhScene& scene, const PreparedRay& ray, std::vector<PrimitiveHit>& hits) {
    HWY_DYNAMIC_DISPATCH(all_prepared)(scene, ray, hits);
}

} // namespace raywise
#endif
