#include "batch/ray_arrays.h"

#include <cstring>
#include <limits>
#include <type_traits>

namespace raywise {
namespace {

template <class To, class Number>
To load(const std::byte* address) {
    Number value;
    std::memcpy(&value, address, sizeof value); // the caller's arrays need not be aligned
    return static_cast<To>(value);
}

// For each array once, not for each of its numbers: of which kind they are. To: the type that they become.
template <class To, class Body>
void for_kind(Scalar scalar, const Body& body) {
    if (std::is_same_v<To, float> || scalar == Scalar::float32) {
        body(float{});
    } else {
        body(double{});
    }
}

template <class To>
void read_vectors(const StridedArray& array, const Elements& elements, glm::vec<3, To> CallerRay<To>::*member,
                  CallerRay<To>* rays) {
    for_kind<To>(array.scalar, [&](auto number) {
        using Number = decltype(number);
        const std::byte* const data = array.data;
        const std::ptrdiff_t step = array.component_stride;
        elements.for_each_offset(array.stride, [=](std::size_t k, std::ptrdiff_t offset) {
            const std::byte* const address = data + offset;
            rays[k].*member = {load<To, Number>(address), load<To, Number>(address + step),
                               load<To, Number>(address + 2 * step)};
        });
    });
}

template <class To>
void read_numbers(const StridedArray& array, const Elements& elements, To absent, To CallerRay<To>::*member,
                  CallerRay<To>* rays) {
    if (array.data == nullptr) {
        for (std::size_t k = 0; k < elements.count(); ++k) rays[k].*member = absent;
        return;
    }
    for_kind<To>(array.scalar, [&](auto number) {
        using Number = decltype(number);
        const std::byte* const data = array.data;
        elements.for_each_offset(array.stride, [=](std::size_t k, std::ptrdiff_t offset) {
            rays[k].*member = load<To, Number>(data + offset);
        });
    });
}

template <class To>
void read_rays(const RayArrays& arrays, const Elements& elements, CallerRay<To>* rays) {
    read_vectors(arrays.origin, elements, &CallerRay<To>::origin, rays);
    read_vectors(arrays.direction, elements, &CallerRay<To>::direction, rays);
    read_numbers(arrays.tmin, elements, To(0), &CallerRay<To>::tmin, rays);
    read_numbers(arrays.tmax, elements, std::numeric_limits<To>::infinity(), &CallerRay<To>::tmax, rays);
}

} // namespace

bool RayArrays::are_float32() const {
    for (const StridedArray* array : {&origin, &direction, &tmin, &tmax}) {
        if (array->data != nullptr && array->scalar != Scalar::float32) return false;
    }
    return true;
}

template <class AnyRay>
void RayArrays::read(const Elements& elements, AnyRay* rays) const {
    read_rays(*this, elements, rays);
}
template void RayArrays::read(const Elements&, Ray*) const;
template void RayArrays::read(const Elements&, RayF*) const;

} // namespace raywise
