// The skip lists of a batch, in the caller's arrays.
#pragma once

#include "batch/elements.h"
#include "geometry/primitives.h"
#include "geometry/triangle_mesh.h"
#include "ray/query.h"

#include <cstdint>
#include <string>
#include <vector>

namespace raywise {

// A primitive by its ids; all bits set: the entry stands for nothing.
struct SkipEntry {
    std::uint64_t geometry;
    std::uint64_t primitive;

    bool stands_for_nothing() const {
        return primitive == PrimitiveHit::no_primitive || primitive == ~std::uint64_t{0};
    }
    // The primitive's number. Throws Error(ERROR_INDEX_OUT_OF_RANGE), its text behind where[index], for an id that is not there.
    std::uint32_t number(const Primitives& primitives, const char* where, std::uint64_t index = no_index) const;
    static constexpr std::uint64_t no_index = ~std::uint64_t{0};
    static std::string place(const char* where, std::uint64_t index);
};

struct SkipArrays {
    StridedArray offsets;   // data null: entry i alone is for ray i
    StridedArray geometry;  // data null: 0
    StridedArray primitive; // data null: nothing is skipped

    bool wanted() const { return primitive.data != nullptr; }

    // Looks at every offset and id. Throws Error with ERROR_INVALID_ARGUMENT or ERROR_INDEX_OUT_OF_RANGE, naming the element.
    void check(std::uint64_t rays, const Primitives& primitives) const;

private:
    friend class SkipBlock;
    struct Range {
        std::uint64_t begin;
        std::uint64_t end;
    };
    Range range(std::uint64_t ray) const;
    SkipEntry entry(std::uint64_t k) const { return {geometry.data ? geometry.index(k) : 0, primitive.index(k)}; }
};

// What each of some rays skips, as numbers of primitives.
class SkipBlock {
public:
    // arrays: that were checked.
    void read(const SkipArrays& arrays, const Elements& rays, const Primitives& primitives);

    const Query* queries() const { return queries_.empty() ? nullptr : queries_.data(); } // null: none skips anything

private:
    std::vector<std::uint32_t> numbers_;
    std::vector<std::size_t> ends_; // of each ray's numbers
    std::vector<Query> queries_;
};

// Sorted, and seen as a list.
SkipList sorted(std::vector<std::uint32_t>& numbers);

} // namespace raywise
