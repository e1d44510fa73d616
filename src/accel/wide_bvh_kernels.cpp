#include "accel/wide_bvh_kernels.h"

#include <algorithm>
#include <limits>
#include <optional>

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/wide_bvh_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/plain_ray-inl.h"
#include "accel/wide_streams-inl.h"
#include "accel/wide_traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

// A ray that is prepared when a triangle has to be tested exactly, which half of all rays never come to.
class LazyRay {
public:
    explicit LazyRay(const PreparedRay& ray) : skip_(ray.skip), prepared_(&ray) {}
    explicit LazyRay(const UnpreparedRay& ray) : ray_(&ray.ray), bounds_(&ray.bounds), skip_(ray.skip) {}

    HWY_INLINE const PreparedRay& prepared() {
        if (prepared_ == nullptr) prepared_ = &storage_.emplace(*ray_, *bounds_, skip_);
        return *prepared_;
    }

    const SkipList& skip() const { return skip_; }

private:
    const Ray* ray_ = nullptr;
    const Box* bounds_ = nullptr;
    SkipList skip_;
    const PreparedRay* prepared_ = nullptr;
    std::optional<PreparedRay> storage_;
};

// What all three questions ask of a triangle that may be hit.
class ExactTest {
public:
    template <class AnyRay>
    ExactTest(const WideBvhScene& scene, const AnyRay& ray) : scene_(scene), ray_(ray) {}

    HWY_INLINE bool operator()(const BlockTriangle& triangle, const Corners& corners, PrimitiveHit& hit) {
        return Primitives::test_corners(ray_.prepared(), corners, triangle.primitive(), hit);
    }
    HWY_INLINE bool operator()(const BlockTriangle& triangle, PrimitiveHit& hit) {
        return (*this)(triangle, corners(triangle), hit);
    }
    HWY_INLINE Corners corners(const BlockTriangle& triangle) const {
        return scene_.bvh.exact ? triangle.corners(scene_.bvh.frame) : scene_.primitives.corners(triangle.primitive());
    }
    bool skips(const BlockTriangle& triangle) const {
        const SkipList& skip = ray_.skip();
        return !skip.empty() && skip.contains(triangle.primitive());
    }

private:
    const WideBvhScene& scene_;
    LazyRay ray_;
};

// The triangle of which float32 says that it may be hit first. It is tested exactly when another may be hit about as early, and at the
// end: once for most rays.
struct Pending {
    BlockTriangle triangle;
    float lower; // it is not hit before this s
    bool is_there;
};

// Limits is FrameRay or PlainRayPlace, and `last` what the ray is culled by.
template <class Limits>
class ClosestSink {
public:
    static constexpr bool in_order = true;

    // margin: as PlainRay's. pending: not there at first; what is there when all is visited has to be settled.
    template <class AnyRay>
    ClosestSink(const WideBvhScene& scene, const AnyRay& ray, const Limits& limits, float margin, float& last,
                Pending& pending, PrimitiveHit& best, Corners& corners)
        : test_(scene, ray),
          limits_(limits),
          margin_(margin),
          last_(last),
          pending_(pending),
          best_(best),
          corners_(corners) {}

    HWY_INLINE bool test(const BlockTriangle& triangle, bool certain, float lower, float upper) {
        if (HWY_UNLIKELY(test_.skips(triangle))) return false;
        const float before = certain ? upper + margin_ : std::numeric_limits<float>::infinity();
        if (pending_.is_there && !(before < pending_.lower)) settle();
        if (lower > last_) return false;
        pending_ = {triangle, lower, true};
        last_ = before < last_ ? before : last_;
        return false;
    }
    float last() const { return last_; }

    HWY_NOINLINE void settle() {
        pending_.is_there = false;
        const Corners corners = test_.corners(pending_.triangle);
        PrimitiveHit hit;
        if (!test_(pending_.triangle, corners, hit) || !(hit < best_)) return;
        best_.t = hit.t; // member by member: a copy of what was just written would take long
        best_.u = hit.u;
        best_.v = hit.v;
        best_.primitive = hit.primitive;
        corners_ = corners;
        last_ = std::min(last_, limits_.last(hit.t));
    }
    void finish() {
        if (pending_.is_there) settle();
    }

private:
    ExactTest test_;
    const Limits& limits_;
    const float margin_;
    float& last_;
    Pending& pending_;
    PrimitiveHit& best_;
    Corners& corners_;
};

class AnySink {
public:
    static constexpr bool in_order = false;

    template <class AnyRay>
    AnySink(const WideBvhScene& scene, const AnyRay& ray, float& last, bool& found)
        : test_(scene, ray), last_(last), found_(found) {}

    HWY_INLINE bool test(const BlockTriangle& triangle, bool certain, float, float) {
        if (HWY_UNLIKELY(test_.skips(triangle))) return false;
        PrimitiveHit hit;
        if (!certain && !test_(triangle, hit)) return false;
        found_ = true;
        last_ = -std::numeric_limits<float>::infinity(); // it enters no box any more
        return true;
    }
    float last() const { return last_; }

private:
    ExactTest test_;
    float& last_;
    bool& found_;
};

class AllSink {
public:
    static constexpr bool in_order = false;

    AllSink(const WideBvhScene& scene, const PreparedRay& ray, float last, std::vector<PrimitiveHit>& hits)
        : test_(scene, ray), hits_(hits), last_(last) {}

    bool test(const BlockTriangle& triangle, bool, float, float) {
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

SurfaceHit closest_prepared(const WideBvhScene& scene, const PreparedRay& ray) {
    SurfaceHit best;
    if (scene.bvh.nodes.empty()) return best;
    FrameRay frame_ray(ray, scene.bvh.frame);
    if (frame_ray.misses()) return best;
    Pending pending{};
    ClosestSink<FrameRay> sink(scene, ray, frame_ray, frame_ray.margin(), frame_ray.last_of_ray, pending, best,
                               best.corners);
    traverse(scene.bvh, frame_ray, WideReference::node(0), sink);
    sink.finish();
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
        Pending pending{};
        ClosestSink<PlainRayPlace> sink(scene, ray, place, plain.margin(), plain.last, pending, best, best.corners);
        traverse(scene.bvh, plain, WideReference::node(0), sink);
        sink.finish();
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

// Many rays made ready for streams: those of each octant for one.
class StreamRays {
public:
    // on_odd(i): answers a ray that no stream can take.
    template <class OnOdd>
    StreamRays(const WideBvhScene& scene, const UnpreparedRays& rays, Scratch& scratch, const OnOdd& on_odd)
        : plain_(scratch.take<PlainRay>(rays.count)), places_(scratch.take<PlainRayPlace>(rays.count)) {
        const std::size_t count = rays.count;
        for (std::uint32_t*& numbers : numbers_) numbers = scratch.take<std::uint32_t>(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            const PlainRayStatus status = set_plain_ray(rays.rays[i], scene.bvh.frame, plain_[i], places_[i]);
            if (HWY_LIKELY(status == PlainRayStatus::plain)) {
                const std::size_t octant = plain_[i].octant;
                numbers_[octant][counts_[octant]++] = i;
            } else if (status == PlainRayStatus::odd) {
                on_odd(i);
            }
        }
    }

    PlainRay& plain(std::size_t i) { return plain_[i]; }
    const PlainRayPlace& place(std::size_t i) const { return places_[i]; }

    template <class Sink>
    void trace(const WideBvh& bvh, Sink& sink, Scratch& scratch) const {
        const std::uint32_t most = *std::max_element(counts_, counts_ + octant_count);
        if (most == 0) return;
        Stream<Sink> stream(bvh, plain_, most, sink, scratch);
        for (std::uint32_t octant = 0; octant < octant_count; ++octant) {
            if (counts_[octant] > 0) stream.run(numbers_[octant], counts_[octant], octant);
        }
    }

private:
    static constexpr std::size_t octant_count = 8;

    PlainRay* const plain_;
    PlainRayPlace* const places_;
    std::uint32_t* numbers_[octant_count];
    std::uint32_t counts_[octant_count] = {};
};

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
    std::fill_n(pending, rays.count, Pending{});
    ClosestOfMany sink{scene, rays, stream_rays, pending, hits};
    stream_rays.trace(scene.bvh, sink, scratch);
    for (std::size_t i = 0; i < rays.count; ++i) {
        if (pending[i].is_there) sink.of_ray(i).settle();
    }
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
