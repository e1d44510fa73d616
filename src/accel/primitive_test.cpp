#include "accel/primitive_test.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/primitive_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/primitive_test-inl.h"

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

template <class Collector>
bool test_kernel(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                 Collector& collector) {
    return test_listed(primitives, BlockRay(ray), list, count, collector);
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

bool test_gathered(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                   ClosestCollector& collector) {
    return HWY_DYNAMIC_DISPATCH(test_closest)(primitives, ray, list, count, collector);
}
bool test_gathered(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                   AnyCollector& collector) {
    return HWY_DYNAMIC_DISPATCH(test_any)(primitives, ray, list, count, collector);
}
bool test_gathered(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                   AllCollector& collector) {
    return HWY_DYNAMIC_DISPATCH(test_all)(primitives, ray, list, count, collector);
}

} // namespace raywise
#endif
