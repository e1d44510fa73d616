// The caller's memory that a batch reads and writes: no byte of an output may belong to another output or to the rays.
#pragma once

#include "base/shared_bytes.h"
#include "batch/hit_arrays.h"
#include "batch/ray_arrays.h"

#include <array>
#include <cstdint>

namespace raywise::capi {

class BatchMemory {
public:
    // The skip lists have to be checked before: their offsets say how many entries there are.
    void reads(const RayArrays& rays);
    void reads(const char* name, const volatile std::int32_t* number); // null: none
    void writes(const HitArrays& hits, std::uint64_t count);
    void writes(const char* name, const OutputArray& output, std::uint64_t count, int components);
    void writes(const char* name, const std::uint64_t* numbers, std::uint64_t count); // null: none

    // Throws Error(ERROR_SHARED_MEMORY) with the names of the first two that do.
    void refuse_shared() const;

private:
    struct Array {
        const char* name = nullptr;
        ByteLayout layout;
        bool is_written = false;
    };
    void read(const char* name, const StridedArray& array, std::uint64_t count, int components);
    void add(const Array& array);

    // Six outputs of hits, offsets, needed and invalid_rays; seven arrays of rays; cancel.
    std::array<Array, 17> arrays_;
    std::size_t count_ = 0;
};

} // namespace raywise::capi
