#include "shared_memory.h"

#include "base/error.h"

#include <algorithm>
#include <string>

namespace raywise::capi {
namespace {

std::uintptr_t address_of(const volatile void* memory) { return reinterpret_cast<std::uintptr_t>(memory); }

} // namespace

void BatchMemory::add(const Array& array) {
    if (!array.layout.is_empty()) arrays_[count_++] = array;
}

void BatchMemory::read(const char* name, const StridedArray& array, std::uint64_t count, int components) {
    if (array.data == nullptr) return;
    if (array.stride == 0) count = std::min<std::uint64_t>(count, 1); // one element for all
    add({name,
         {address_of(array.data), count, array.stride, components, array.component_stride, size_of(array.scalar)},
         false});
}

void BatchMemory::reads(const RayArrays& rays) {
    read("rays.origin", rays.origin, rays.count, 3);
    read("rays.direction", rays.direction, rays.count, 3);
    read("rays.tmin", rays.tmin, rays.count, 1);
    read("rays.tmax", rays.tmax, rays.count, 1);
    const SkipArrays& skip = rays.skip;
    if (!skip.wanted()) return;
    const bool has_lists = skip.offsets.data != nullptr;
    const std::uint64_t entries = has_lists ? skip.offsets.index(rays.count) : rays.count;
    read("rays.skip_offsets", skip.offsets, rays.count + 1, 1);
    read("rays.skip_geometry", skip.geometry, entries, 1);
    read("rays.skip_primitive", skip.primitive, entries, 1);
}

void BatchMemory::reads(const char* name, const volatile std::int32_t* number) {
    if (number == nullptr) return;
    add({name, {address_of(number), 1, sizeof *number, 1, sizeof *number, sizeof *number}, false});
}

void BatchMemory::writes(const char* name, const OutputArray& output, std::uint64_t count, int components) {
    if (!output.wanted()) return;
    add({name,
         {address_of(output.data), count, output.stride, components, output.component_stride, size_of(output.scalar)},
         true});
}

void BatchMemory::writes(const char* name, const std::uint64_t* numbers, std::uint64_t count) {
    if (numbers == nullptr) return;
    add({name, {address_of(numbers), count, sizeof *numbers, 1, sizeof *numbers, sizeof *numbers}, true});
}

void BatchMemory::writes(const HitArrays& hits, std::uint64_t count) {
    writes("hits.t", hits.t, count, 1);
    writes("hits.uv", hits.uv, count, 2);
    writes("hits.normal", hits.normal, count, 3);
    writes("hits.instance", hits.instance, count, 1);
    writes("hits.geometry", hits.geometry, count, 1);
    writes("hits.primitive", hits.primitive, count, 1);
}

void BatchMemory::refuse_shared() const {
    for (std::size_t i = 0; i < count_; ++i) {
        for (std::size_t j = i + 1; j < count_; ++j) {
            const Array& one = arrays_[i];
            const Array& other = arrays_[j];
            if ((one.is_written || other.is_written) && share_bytes(one.layout, other.layout)) {
                throw Error(Status::ERROR_SHARED_MEMORY,
                            std::string(one.name) + " and " + other.name + ": they share memory");
            }
        }
    }
}

} // namespace raywise::capi
