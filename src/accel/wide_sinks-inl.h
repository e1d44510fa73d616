// What the walk (wide_traversal-inl.h) finds, for each of the three questions. For each target of Highway once: include it inside the
// loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_WIDE_SINKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_WIDE_SINKS_INL_H_
#undef RAYWISE_ACCEL_WIDE_SINKS_INL_H_
#else
#define RAYWISE_ACCEL_WIDE_SINKS_INL_H_
#endif

#include "accel/wide_bvh_kernels.h"

#include <hwy/highway.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {

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

// Triangles of which float32 says that one of them may be hit first. They are tested exactly when there are more, and at the end: once
// for most rays, twice for those that start on a surface.
struct Pending {
    static constexpr std::uint32_t most = 2;

    struct Candidate {
        BlockTriangle triangle;
        float lower; // it is not hit before this s
    };

    // A certain hit at or before s makes others useless.
    HWY_INLINE void drop_beyond(float s) {
        std::uint32_t kept = 0;
        for (std::uint32_t k = 0; k < count; ++k) {
            if (!(s < candidates[k].lower)) candidates[kept++] = candidates[k];
        }
        count = kept;
    }

    Candidate candidates[most];
    std::uint32_t count; // 0 at first
};

// Limits is FrameRay or PlainRayPlace, and `last` what the ray is culled by.
template <class Limits>
class ClosestSink {
public:
    static constexpr bool in_order = true;

    // margin: as PlainRay's. What is pending when all has been visited has to be settled.
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
        if (lower > last_) return false;
        if (certain) {
            const float before = upper + margin_;
            pending_.drop_beyond(before);
            last_ = before < last_ ? before : last_;
        }
        if (pending_.count == Pending::most) {
            settle();
            if (lower > last_) return false;
        }
        pending_.candidates[pending_.count++] = {triangle, lower};
        return false;
    }
    float last() const { return last_; }

    HWY_NOINLINE void settle() {
        for (std::uint32_t k = 0; k < pending_.count; ++k) {
            if (!(pending_.candidates[k].lower > last_)) settle(pending_.candidates[k].triangle);
        }
        pending_.count = 0;
    }

    void settle(const BlockTriangle& triangle) {
        const Corners corners = test_.corners(triangle);
        PrimitiveHit hit;
        if (!test_(triangle, corners, hit) || !(hit < best_)) return;
        best_.t = hit.t; // member by member: a copy of what was just written would take long
        best_.u = hit.u;
        best_.v = hit.v;
        best_.primitive = hit.primitive;
        corners_ = corners;
        last_ = std::min(last_, limits_.last(hit.t));
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

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
