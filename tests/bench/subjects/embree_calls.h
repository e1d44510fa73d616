// Embree's queries, in which versions 3 and 4 differ: 3 takes a context before the ray, 4 optional arguments after it, and 4's
// hit ends in one more id.
#pragma once

#include "bench/subjects/embree_library.h"

#include <cstring>
#include <type_traits>

namespace raywise::bench {

template <class Function>
Function* function_at(void* address) {
    Function* function = nullptr;
    std::memcpy(&function, &address, sizeof function);
    return function;
}

class Embree3Calls {
public:
    using RayHit = RTCRayHit;
    using RayHit8 = RTCRayHit8;

    Embree3Calls(const EmbreeLibrary& library, RTCScene scene, bool coherent)
        : scene_(scene),
          intersect1_(function_at<decltype(::rtcIntersect1)>(library.intersect1)),
          occluded1_(function_at<decltype(::rtcOccluded1)>(library.occluded1)),
          intersect8_(function_at<decltype(::rtcIntersect8)>(library.intersect8)),
          occluded8_(function_at<decltype(::rtcOccluded8)>(library.occluded8)),
          coherent_(coherent) {}

    // Each thread has its own.
    class Context {
    public:
        explicit Context(const Embree3Calls& calls) : calls_(calls) {
            rtcInitIntersectContext(&context_);
            if (calls.coherent_) context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        }
        void intersect(RayHit& ray) { calls_.intersect1_(calls_.scene_, &context_, &ray); }
        void occluded(RTCRay& ray) { calls_.occluded1_(calls_.scene_, &context_, &ray); }
        void intersect(const int* valid, RayHit8& rays) { calls_.intersect8_(valid, calls_.scene_, &context_, &rays); }
        void occluded(const int* valid, RTCRay8& rays) { calls_.occluded8_(valid, calls_.scene_, &context_, &rays); }

    private:
        const Embree3Calls& calls_;
        RTCIntersectContext context_;
    };

private:
    RTCScene scene_;
    decltype(&::rtcIntersect1) intersect1_;
    decltype(&::rtcOccluded1) occluded1_;
    decltype(&::rtcIntersect8) intersect8_;
    decltype(&::rtcOccluded8) occluded8_;
    bool coherent_;
};

// Embree 4's structs, as its manual describes them. There are no headers where the library comes out of a Python wheel.
class Embree4Calls {
public:
    struct RayHit {
        RTCRay ray;
        RTCHit hit;
        unsigned int instance_primitive[4]; // since 4.4, one; the rest is room to spare
    };
    struct RayHit8 {
        RTCRay8 ray;
        RTCHit8 hit;
        unsigned int instance_primitive[8];
    };
    static constexpr int coherent_flag = 1 << 16;
    struct Arguments {
        int flags;
        unsigned int features;
        void* context;
        void* filter;
        void* user_geometry;
        float width_factor;
        char room_to_spare[64];
    };

    Embree4Calls(const EmbreeLibrary& library, RTCScene scene, bool coherent)
        : scene_(scene),
          intersect1_(function_at<One<RayHit>>(library.intersect1)),
          occluded1_(function_at<One<RTCRay>>(library.occluded1)),
          intersect8_(function_at<Many<RayHit8>>(library.intersect8)),
          occluded8_(function_at<Many<RTCRay8>>(library.occluded8)),
          coherent_(coherent) {}

    class Context {
    public:
        explicit Context(const Embree4Calls& calls) : calls_(calls) {
            arguments_.features = 0xFFFFFFFFu; // all
            if (calls.coherent_) arguments_.flags = coherent_flag;
        }
        void intersect(RayHit& ray) { calls_.intersect1_(calls_.scene_, &ray, &arguments_); }
        void occluded(RTCRay& ray) { calls_.occluded1_(calls_.scene_, &ray, &arguments_); }
        void intersect(const int* valid, RayHit8& rays) {
            calls_.intersect8_(valid, calls_.scene_, &rays, &arguments_);
        }
        void occluded(const int* valid, RTCRay8& rays) { calls_.occluded8_(valid, calls_.scene_, &rays, &arguments_); }

    private:
        const Embree4Calls& calls_;
        Arguments arguments_{};
    };

private:
    template <class Rays>
    using One = void(RTCScene, Rays*, Arguments*);
    template <class Rays>
    using Many = void(const int*, RTCScene, Rays*, Arguments*);

    RTCScene scene_;
    One<RayHit>* intersect1_;
    One<RTCRay>* occluded1_;
    Many<RayHit8>* intersect8_;
    Many<RTCRay8>* occluded8_;
    bool coherent_;
};

} // namespace raywise::bench
