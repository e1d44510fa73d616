// The questions that a ray asks of a structure whose traversal is compiled for each target of Highway, and their way to the best of them.
//
// A traversal has, where it is compiled for each target,
//     template <class AnyRay, class Collector> void trace(const Traced& traced, const AnyRay& ray, Collector& collector);
// for Ray and RayF. RW_RAY_KERNELS(Traced) behind it, in the same namespace, makes the kernels, and RW_DISPATCH_RAY_KERNELS(Traced), where
// HWY_ONCE is set, the functions that choose among them, for which base/dispatch.h has to be included behind hwy/foreach_target.h;
// RW_DECLARE_RAY_KERNELS(Traced) declares those. Macros, because Highway dispatches plain functions by name.
#pragma once

#include "accel/collectors.h"

// As the functions of Accel. One hit on a primitive may be collected several times.
#define RW_DECLARE_RAY_KERNELS(Traced)                                                     \
    PrimitiveHit trace_closest(const Traced& traced, const Ray& ray, const Query& query);  \
    PrimitiveHit trace_closest(const Traced& traced, const RayF& ray, const Query& query); \
    bool trace_any(const Traced& traced, const Ray& ray, const Query& query);              \
    bool trace_any(const Traced& traced, const RayF& ray, const Query& query);             \
    void trace_all(const Traced& traced, const Ray& ray, AllCollector& collector)

#define RW_CLOSEST_KERNEL(name, Traced, AnyRay)                                      \
    PrimitiveHit name(const Traced& traced, const AnyRay& ray, const Query& query) { \
        ClosestCollector collector(ray, query);                                      \
        trace(traced, ray, collector);                                               \
        return collector.best();                                                     \
    }

#define RW_ANY_KERNEL(name, Traced, AnyRay)                                  \
    bool name(const Traced& traced, const AnyRay& ray, const Query& query) { \
        AnyCollector collector(ray, query);                                  \
        trace(traced, ray, collector);                                       \
        return collector.found();                                            \
    }

#define RW_RAY_KERNELS(Traced)                          \
    RW_CLOSEST_KERNEL(closest_kernel, Traced, Ray)      \
    RW_CLOSEST_KERNEL(closest_f32_kernel, Traced, RayF) \
    RW_ANY_KERNEL(any_kernel, Traced, Ray)              \
    RW_ANY_KERNEL(any_f32_kernel, Traced, RayF)         \
    void all_kernel(const Traced& traced, const Ray& ray, AllCollector& collector) { trace(traced, ray, collector); }

#define RW_DISPATCH_RAY_KERNELS(Traced)                                                     \
    HWY_EXPORT(closest_kernel);                                                             \
    HWY_EXPORT(closest_f32_kernel);                                                         \
    HWY_EXPORT(any_kernel);                                                                 \
    HWY_EXPORT(any_f32_kernel);                                                             \
    HWY_EXPORT(all_kernel);                                                                 \
    PrimitiveHit trace_closest(const Traced& traced, const Ray& ray, const Query& query) {  \
        return RW_DISPATCH(closest_kernel)(traced, ray, query);                             \
    }                                                                                       \
    PrimitiveHit trace_closest(const Traced& traced, const RayF& ray, const Query& query) { \
        return RW_DISPATCH(closest_f32_kernel)(traced, ray, query);                         \
    }                                                                                       \
    bool trace_any(const Traced& traced, const Ray& ray, const Query& query) {              \
        return RW_DISPATCH(any_kernel)(traced, ray, query);                                 \
    }                                                                                       \
    bool trace_any(const Traced& traced, const RayF& ray, const Query& query) {             \
        return RW_DISPATCH(any_f32_kernel)(traced, ray, query);                             \
    }                                                                                       \
    void trace_all(const Traced& traced, const Ray& ray, AllCollector& collector) {         \
        RW_DISPATCH(all_kernel)(traced, ray, collector);                                    \
    }
