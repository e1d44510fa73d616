#include "batch/ray_arrays.h"

#include <cstring>
#include <limits>

namespace raywise {
namespace {

template <class Number>
double load(const std::byte* address) {
    Number value;
    std::memcpy(&value, address, sizeof value); // the caller's arrays need not be aligned
    return static_cast<double>(value);
}

// For each array once, not for each of its numbers: of which kind they are.
template <class Body>
void for_kind(Scalar scalar, const Body& body) {
    if (scalar == Scalar::float32) {
        body(float{});
    } else {
        body(double{});
    }
}

void read_vectors(const StridedArray& array, const Elements& elements, Vec3 Ray::*member, Ray* rays) {
    for_kind(array.scalar, [&](auto number) {
        using Number = decltype(number);
        const std::ptrdiff_t step = array.component_stride;
        for (std::size_t k = 0; k < elements.count(); ++k) {
            const std::byte* const address = array.data + static_cast<std::ptrdiff_t>(elements[k]) * array.stride;
            rays[k].*member = {load<Number>(address), load<Number>(address + step), load<Number>(address + 2 * step)};
        }
    });
}

void read_numbers(const StridedArray& array, const Elements& elements, double absent, double Ray::*member, Ray* rays) {
    if (array.data == nullptr) {
        for (std::size_t k = 0; k < elements.count(); ++k) rays[k].*member = absent;
        return;
    }
    for_kind(array.scalar, [&](auto number) {
        using Number = decltype(number);
        for (std::size_t k = 0; k < elements.count(); ++k)
            rays[k].*member = load<Number>(array.data + static_cast<std::ptrdiff_t>(elements[k]) * array.stride);
    });
}

} // namespace

void RayArrays::read(const Elements& elements, Ray* rays) const {
    read_vectors(origin, elements, &Ray::origin, rays);
    read_vectors(direction, elements, &Ray::direction, rays);
    read_numbers(tmin, elements, 0.0, &Ray::tmin, rays);
    read_numbers(tmax, elements, std::numeric_limits<double>::infinity(), &Ray::tmax, rays);
}

} // namespace raywise
