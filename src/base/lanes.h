// Four numbers side by side, for the vector instructions that every processor has.
#pragma once

#include <cstdint>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

// Inlined into functions that are compiled for another instruction set, code is compiled for that as well.
#define RW_INLINE inline __attribute__((always_inline))

namespace raywise {

// Four lanes, by the vectors that GCC and Clang have of their own: every processor we run on has instructions for them,
// and Highway has none for plain x86-64. GCC 12 takes a choice between two vectors apart into single lanes for x86-64,
// hence the two intrinsics.
using Lanes = float __attribute__((vector_size(16)));
using IntLanes = std::int32_t __attribute__((vector_size(16)));
using CountLanes = std::uint32_t __attribute__((vector_size(16)));

RW_INLINE Lanes fill_lanes(float value) { return Lanes{value, value, value, value}; }
#if defined(__SSE__)
RW_INLINE Lanes min_lanes(Lanes a, Lanes b) { return _mm_min_ps(a, b); }
RW_INLINE Lanes max_lanes(Lanes a, Lanes b) { return _mm_max_ps(a, b); }
#else
RW_INLINE Lanes min_lanes(Lanes a, Lanes b) { return a < b ? a : b; }
RW_INLINE Lanes max_lanes(Lanes a, Lanes b) { return a > b ? a : b; }
#endif

// a where the mask is -1, b where it is 0.
RW_INLINE Lanes select(IntLanes mask, Lanes a, Lanes b) {
    return reinterpret_cast<Lanes>((reinterpret_cast<IntLanes>(a) & mask) | (reinterpret_cast<IntLanes>(b) & ~mask));
}

} // namespace raywise
