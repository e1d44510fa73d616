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
using DoubleLanes =
    double __attribute__((vector_size(32))); // passed by reference: not every processor has registers for them

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

// x, y and z of four points.
RW_INLINE void to_axes(const Lanes (&points)[4], Lanes (&axes)[3]) {
    const Lanes xy01 = __builtin_shufflevector(points[0], points[1], 0, 4, 1, 5);
    const Lanes xy23 = __builtin_shufflevector(points[2], points[3], 0, 4, 1, 5);
    const Lanes z01 = __builtin_shufflevector(points[0], points[1], 2, 6, 3, 7);
    const Lanes z23 = __builtin_shufflevector(points[2], points[3], 2, 6, 3, 7);
    axes[0] = __builtin_shufflevector(xy01, xy23, 0, 1, 4, 5);
    axes[1] = __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7);
    axes[2] = __builtin_shufflevector(z01, z23, 0, 1, 4, 5);
}

// The largest floats not above x, and the smallest not below. |x| has to be at most FLT_MAX. A float's neighbours are those of its bits.
RW_INLINE Lanes round_down(const DoubleLanes& x) {
    const Lanes nearest = __builtin_convertvector(x, Lanes);
    const IntLanes above = __builtin_convertvector(__builtin_convertvector(nearest, DoubleLanes) > x, IntLanes);
    const IntLanes bits = reinterpret_cast<IntLanes>(nearest);
    return reinterpret_cast<Lanes>(bits - (above & (bits >> 31 | 1)));
}
RW_INLINE Lanes round_up(const DoubleLanes& x) {
    const Lanes nearest = __builtin_convertvector(x, Lanes);
    const IntLanes below = __builtin_convertvector(__builtin_convertvector(nearest, DoubleLanes) < x, IntLanes);
    const IntLanes bits = reinterpret_cast<IntLanes>(nearest);
    return reinterpret_cast<Lanes>(bits + (below & (bits >> 31 | 1)));
}

} // namespace raywise
