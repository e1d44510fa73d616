#include "accel/wide_bvh_kernels.h"

#include "geometry/triangle_tests.h"

#include <algorithm>

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/wide_bvh_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/plain_ray-inl.h"
#include "accel/wide_sinks-inl.h"
#include "accel/wide_streams-inl.h"
#include "accel/wide_traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

SurfaceHit closest_prepared(const WideBvhScene& scene, const PreparedRay& ray) {
    SurfaceHit best;
    if (scene.bvh.nodes.empty()) return best;
    FrameRay frame_ray(ray, scene.bvh.frame);
    if (frame_ray.misses()) return best;
    Pending pending;
    pending.count = 0;
    ClosestSink<FrameRay> sink(scene, ray, frame_ray, frame_ray.margin(), frame_ray.last_of_ray, pending, best,
                               best.corners);
    traverse(scene.bvh, frame_ray, WideReference::node(0), sink);
    sink.settle();
    return best;
}

bool any_prepared(const WideBvhScene& scene, const PreparedRay& ray) {
    bool found = false;
    if (scene.bvh.nodes.empty()) return found;
    FrameRay frame_ray(ray, scene.bvh.frame);
    if (frame_ray.misses()) return found;
    AnySink sink(scene, ray, frame_ray.last_of_ray, found);
    traverse(scene.bvh, frame_ray, WideReference::node(0), sink);
    return found;
}

HWY_NOINLINE SurfaceHit closest_odd(const WideBvhScene& scene, const UnpreparedRay& ray) {
    return PreparedRay::is_traceable(ray.ray) ? closest_prepared(scene, ray.prepare()) : SurfaceHit{};
}
HWY_NOINLINE bool any_odd(const WideBvhScene& scene, const UnpreparedRay& ray) {
    return PreparedRay::is_traceable(ray.ray) && any_prepared(scene, ray.prepare());
}

// One variable is returned, so that it is made where the caller wants it: one that was just written takes long to copy.
SurfaceHit closest_unprepared(const WideBvhScene& scene, const UnpreparedRay& ray) {
    SurfaceHit best;
    if (scene.bvh.nodes.empty()) return best;
    PlainRay plain;
    PlainRayPlace place;
    const PlainRayStatus status = set_plain_ray(ray.ray, scene.bvh.frame, plain, place);
    if (HWY_LIKELY(status == PlainRayStatus::plain)) {
        Pending pending;
        pending.count = 0;
        ClosestSink<PlainRayPlace> sink(scene, ray, place, plain.margin(), plain.last, pending, best, best.corners);
        traverse(scene.bvh, plain, WideReference::node(0), sink);
        sink.settle();
    } else if (status == PlainRayStatus::odd) {
        best = closest_odd(scene, ray);
    }
    return best;
}

bool any_unprepared(const WideBvhScene& scene, const UnpreparedRay& ray) {
    bool found = false;
    if (scene.bvh.nodes.empty()) return found;
    PlainRay plain;
    PlainRayPlace place;
    const PlainRayStatus status = set_plain_ray(ray.ray, scene.bvh.frame, plain, place);
    if (HWY_LIKELY(status == PlainRayStatus::plain)) {
        AnySink sink(scene, ray, plain.last, found);
        traverse(scene.bvh, plain, WideReference::node(0), sink);
    } else if (status == PlainRayStatus::odd) {
        found = any_odd(scene, ray);
    }
    return found;
}

void all_prepared(const WideBvhScene& scene, const PreparedRay& ray, std::vector<PrimitiveHit>& hits) {
    if (scene.bvh.nodes.empty()) return;
    const FrameRay frame_ray(ray, scene.bvh.frame);
    if (frame_ray.misses()) return;
    AllSink sink(scene, ray, frame_ray.last_of_ray, hits);
    traverse(scene.bvh, frame_ray, WideReference::node(0), sink);
}

struct ClosestOfMany {
    static constexpr bool in_order = true;

    const WideBvhScene& scene;
    const UnpreparedRays& rays;
    StreamRays& stream_rays;
    Pending* pending;
    const SurfaceHits& hits;

    bool is_done(std::size_t) const { return false; }
    ClosestSink<PlainRayPlace> of_ray(std::size_t i) {
        PlainRay& plain = stream_rays.plain(i);
        return {scene,      rays[i],    stream_rays.place(i), plain.margin(),
                plain.last, pending[i], hits.hits[i],         hits.corners[i]};
    }
};

// What is pending when all has been visited, tested several at once.
class LastTests {
public:
    explicit LastTests(ClosestOfMany& sink) : sink_(sink) {}

    HWY_INLINE void add(std::size_t i, const BlockTriangle& triangle) {
        const std::size_t k = tests_.size();
        rays_[k] = i;
        triangles_[k] = triangle;
        corners_[k] = ExactTest(sink_.scene, sink_.rays[i]).corners(triangle);
        tests_.add(sink_.rays.rays[i], corners_[k]);
        if (tests_.is_full()) finish();
    }

    HWY_NOINLINE void finish() {
        tests_.run();
        for (std::size_t k = 0; k < tests_.size(); ++k) {
            const std::size_t i = rays_[k];
            if (tests_.answer(k) == TriangleTests::Answer::unknown) sink_.of_ray(i).settle(triangles_[k]);
            if (tests_.answer(k) != TriangleTests::Answer::hits) continue;
            const PrimitiveHit hit{tests_.t(k), tests_.u(k), tests_.v(k), triangles_[k].primitive()};
            if (!(hit < sink_.hits.hits[i])) continue;
            sink_.hits.hits[i] = hit;
            sink_.hits.corners[i] = corners_[k];
        }
        tests_.clear();
    }

private:
    ClosestOfMany& sink_;
    TriangleTests tests_;
    std::size_t rays_[TriangleTests::most];
    BlockTriangle triangles_[TriangleTests::most];
    Corners corners_[TriangleTests::most];
};

struct AnyOfMany {
    static constexpr bool in_order = false;

    const WideBvhScene& scene;
    const UnpreparedRays& rays;
    StreamRays& stream_rays;
    bool* found;

    bool is_done(std::size_t i) const { return found[i]; }
    AnySink of_ray(std::size_t i) { return {scene, rays[i], stream_rays.plain(i).last, found[i]}; }
};

// A stream of fewer is not worth what it takes to make it ready.
constexpr std::size_t smallest_stream = 32;

void closest_of_many(const WideBvhScene& scene, const UnpreparedRays& rays, const SurfaceHits& hits, Scratch& scratch) {
    if (rays.count < smallest_stream || scene.bvh.nodes.empty()) {
        for (std::size_t i = 0; i < rays.count; ++i) hits.put(i, closest_unprepared(scene, rays[i]));
        return;
    }
    std::fill_n(hits.hits, rays.count, PrimitiveHit{});
    StreamRays stream_rays(scene, rays, scratch, [&](std::size_t i) { hits.put(i, closest_odd(scene, rays[i])); });
    auto* const pending = scratch.take<Pending>(rays.count);
    for (std::size_t i = 0; i < rays.count; ++i) pending[i].count = 0;
    ClosestOfMany sink{scene, rays, stream_rays, pending, hits};
    stream_rays.trace(scene.bvh, sink, scratch);
    LastTests last_tests(sink);
    for (std::size_t i = 0; i < rays.count; ++i) {
        for (std::uint32_t k = 0; k < pending[i].count; ++k) {
            const Pending::Candidate& candidate = pending[i].candidates[k];
            if (!(candidate.lower > stream_rays.plain(i).last)) last_tests.add(i, candidate.triangle);
        }
    }
    last_tests.finish();
}

void any_of_many(const WideBvhScene& scene, const UnpreparedRays& rays, bool* found, Scratch& scratch) {
    if (rays.count < smallest_stream || scene.bvh.nodes.empty()) {
        for (std::size_t i = 0; i < rays.count; ++i) found[i] = any_unprepared(scene, rays[i]);
        return;
    }
    std::fill_n(found, rays.count, false);
    StreamRays stream_rays(scene, rays, scratch, [&](std::size_t i) { found[i] = any_odd(scene, rays[i]); });
    AnyOfMany sink{scene, rays, stream_rays, found};
    stream_rays.trace(scene.bvh, sink, scratch);
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(closest_prepared);
HWY_EXPORT(closest_unprepared);
HWY_EXPORT(closest_of_many);
HWY_EXPORT(any_prepared);
HWY_EXPORT(any_unprepared);
HWY_EXPORT(any_of_many);
HWY_EXPORT(all_prepared);

SurfaceHit closest_hit(const WideBvhScene& scene, const PreparedRay& ray) {
    return HWY_DYNAMIC_DISPATCH(closest_prepared)(scene, ray);
}
SurfaceHit closest_hit(const WideBvhScene& scene, const UnpreparedRay& ray) {
    return HWY_DYNAMIC_DISPATCH(closest_unprepared)(scene, ray);
}
void closest_hits(const WideBvhScene& scene, const UnpreparedRays& rays, const SurfaceHits& hits, Scratch& scratch) {
    HWY_DYNAMIC_DISPATCH(closest_of_many)(scene, rays, hits, scratch);
}
bool any_hit(const WideBvhScene& scene, const PreparedRay& ray) {
    return HWY_DYNAMIC_DISPATCH(any_prepared)(scene, ray);
}
bool any_hit(const WideBvhScene& scene, const UnpreparedRay& ray) {
    return HWY_DYNAMIC_DISPATCH(any_unprepared)(scene, ray);
}
void any_hits(const WideBvhScene& scene, const UnpreparedRays& rays, bool* found, Scratch& scratch) {
    HWY_DYNAMIC_DISPATCH(any_of_many)(scene, rays, found, scratch);
}
void all_hits(const WideBvhScene& scene, const PreparedRay& ray, std::vector<PrimitiveHit>& hits) {
    HWY_DYNAMIC_DISPATCH(all_prepared)(scene, ray, hits);
}

} // namespace raywise
#endif
