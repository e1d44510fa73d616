#include "accel/primitive_test.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/primitive_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "geometry/triangle_block-inl.h"

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

// Few triangles are told one by one before their corners are gathered.
inline constexpr std::size_t fewest_to_gather = 3;

template <class Collector>
bool test_kernel(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                 Collector& collector) {
    if (count < fewest_to_gather) {
        for (std::size_t i = 0; i < count; ++i) {
            PrimitiveHit hit;
            if (primitives.test(ray, list[i], hit) && collector.collect(hit)) return true;
        }
        return false;
    }
    const BlockRay block_ray(ray);
    alignas(64)
        std::byte data[TriangleBlock<double>::bytes_per_triangle * triangle_block_size + triangle_block_padding];
    std::uint32_t ids[triangle_block_size];
    for (std::size_t next = 0; next < count;) {
        std::uint32_t n = 0;
        for (; next < count && n < triangle_block_size; ++next) {
            if (primitives.is_hittable(list[next])) ids[n++] = list[next];
        }
        double farthest = 0.0;
        for (std::uint32_t i = 0; i < n; ++i) {
            const Corners corners = primitives.corners(ids[i]);
            double numbers[3][3];
            for (int k = 0; k < 3; ++k) {
                for (int axis = 0; axis < 3; ++axis) {
                    numbers[k][axis] = corners[static_cast<std::size_t>(k)][axis];
                    farthest = larger(farthest, std::fabs(numbers[k][axis] - ray.origin[axis]));
                }
            }
            write_block_triangle(data, n, i, numbers, ids[i]);
        }
        if (test_triangle_block(block_ray, TriangleBlock<double>{data, n}, farthest, collector)) return true;
    }
    return false;
}

bool test_closest(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                  ClosestCollector& collector) {
    return test_kernel(primitives, ray, list, count, collector);
}
bool test_any(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
              AnyCollector& collector) {
    return test_kernel(primitives, ray, list, count, collector);
}
bool test_all(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
              AllCollector& collector) {
    return test_kernel(primitives, ray, list, count, collector);
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(test_closest);
HWY_EXPORT(test_any);
HWY_EXPORT(test_all);

bool test_primitives(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                     ClosestCollector& collector) {
    return HWY_DYNAMIC_DISPATCH(test_closest)(primitives, ray, list, count, collector);
}
bool test_primitives(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                     AnyCollector& collector) {
    return HWY_DYNAMIC_DISPATCH(test_any)(primitives, ray, list, count, collector);
}
bool test_primitives(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                     AllCollector& collector) {
    return HWY_DYNAMIC_DISPATCH(test_all)(primitives, ray, list, count, collector);
}

} // namespace raywise
#endif
