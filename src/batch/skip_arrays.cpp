#include "batch/skip_arrays.h"

#include "base/error.h"

#include <algorithm>
#include <string>

namespace raywise {

std::string SkipEntry::place(const char* where, std::uint64_t index) {
    return index == no_index ? std::string(where) : std::string(where) + "[" + std::to_string(index) + "]";
}

std::uint32_t SkipEntry::number(const Primitives& primitives, const char* where, std::uint64_t index) const {
    const auto& meshes = primitives.meshes();
    const auto fail = [&](const std::string& what) {
        return Error(Status::ERROR_INDEX_OUT_OF_RANGE, place(where, index) + ": " + what);
    };
    if (geometry >= meshes.size()) {
        throw fail("geometry " + std::to_string(geometry) + " is out of range, the scene has " +
                   std::to_string(meshes.size()));
    }
    if (primitive >= meshes[geometry]->triangle_count()) {
        throw fail("primitive " + std::to_string(primitive) + " is out of range, geometry " + std::to_string(geometry) +
                   " has " + std::to_string(meshes[geometry]->triangle_count()) + " triangles");
    }
    return primitives.number({static_cast<std::uint32_t>(geometry), static_cast<std::uint32_t>(primitive)});
}

SkipArrays::Range SkipArrays::range(std::uint64_t ray) const {
    if (offsets.data == nullptr) return {ray, ray + 1};
    return {offsets.index(ray, 0), offsets.index(ray + 1, 0)};
}

void SkipArrays::check(std::uint64_t rays, const Primitives& primitives) const {
    if (!wanted()) return;
    for (std::uint64_t i = 0; i < rays; ++i) {
        const Range entries = range(i);
        if (entries.end < entries.begin) {
            throw Error(Status::ERROR_INVALID_ARGUMENT, "rays.skip_offsets[" + std::to_string(i + 1) +
                                                            "]: " + std::to_string(entries.end) + " is below the " +
                                                            std::to_string(entries.begin) + " before it");
        }
        for (std::uint64_t k = entries.begin; k < entries.end; ++k) {
            const SkipEntry e = entry(k);
            if (!e.stands_for_nothing()) e.number(primitives, "rays.skip_primitive", k);
        }
    }
}

void SkipBlock::read(const SkipArrays& arrays, const Elements& rays, const Primitives& primitives) {
    numbers_.clear();
    queries_.clear();
    ends_.clear();
    if (!arrays.wanted()) return;
    for (std::size_t i = 0; i < rays.count(); ++i) {
        const SkipArrays::Range entries = arrays.range(rays[i]);
        const auto begin = static_cast<std::ptrdiff_t>(numbers_.size());
        for (std::uint64_t k = entries.begin; k < entries.end; ++k) {
            const SkipEntry e = arrays.entry(k);
            if (!e.stands_for_nothing()) numbers_.push_back(e.number(primitives, "rays.skip_primitive", k));
        }
        std::sort(numbers_.begin() + begin, numbers_.end());
        ends_.push_back(numbers_.size());
    }
    queries_.reserve(rays.count());
    const std::uint32_t* begin = numbers_.data();
    for (const std::size_t end : ends_) {
        queries_.push_back({{begin, numbers_.data() + end}});
        begin = numbers_.data() + end;
    }
}

SkipList sorted(std::vector<std::uint32_t>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    return {numbers.data(), numbers.data() + numbers.size()};
}

} // namespace raywise
