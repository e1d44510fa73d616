// Boxes while a hierarchy is built: in float32, four lanes wide.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace raywise {

// What a hierarchy is built of, a primitive or a cluster of some: its box, and two numbers in the lanes that boxes leave
// free.
struct alignas(32) BuildItem {
    float lower[3];
    std::uint32_t id;
    float upper[3];
    std::uint32_t count; // primitives in it

    // Of its box; does not overflow.
    float centroid(int axis) const { return 0.5f * lower[axis] + 0.5f * upper[axis]; }
};

// Memory without initial values: what holds one element per primitive is written once, by many threads.
template <class T>
std::unique_ptr<T[]> make_uninitialised(std::size_t count) {
    return std::unique_ptr<T[]>(new T[count]);
}

// Four lanes, by the vectors that GCC and Clang have of their own: every processor we run on has instructions for them,
// and Highway has none for plain x86-64. GCC 12 takes a choice between two vectors apart into single lanes for x86-64,
// hence the two intrinsics.
using Lanes = float __attribute__((vector_size(16)));
using IntLanes = std::int32_t __attribute__((vector_size(16)));
using CountLanes = std::uint32_t __attribute__((vector_size(16)));

inline Lanes fill_lanes(float value) { return Lanes{value, value, value, value}; }
#if defined(__SSE__)
inline Lanes min_lanes(Lanes a, Lanes b) { return _mm_min_ps(a, b); }
inline Lanes max_lanes(Lanes a, Lanes b) { return _mm_max_ps(a, b); }
#else
inline Lanes min_lanes(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes max_lanes(Lanes a, Lanes b) { return a > b ? a : b; }
#endif

struct Bounds {
    Lanes lower;
    Lanes upper;

    static Bounds none() {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        return {fill_lanes(infinity), fill_lanes(-infinity)};
    }
    // The lanes of the item's numbers become zero: most are denormal as floats, and arithmetic on those is slow.
    static Bounds of(const BuildItem& item) {
        IntLanes bits[2];
        std::memcpy(bits, &item, sizeof bits);
        const IntLanes box{-1, -1, -1, 0};
        return {reinterpret_cast<Lanes>(bits[0] & box), reinterpret_cast<Lanes>(bits[1] & box)};
    }
    // Of the centroid alone: BuildItem::centroid on each axis.
    static Bounds of_centroid(const BuildItem& item) {
        const Lanes c = of(item).centroid();
        return {c, c};
    }
    Lanes centroid() const { return 0.5f * lower + 0.5f * upper; } // does not overflow

    void extend(const Bounds& other) {
        lower = min_lanes(other.lower, lower);
        upper = max_lanes(other.upper, upper);
    }

    // What to multiply with for the largest extent to become about one: a power of two, and a normal number.
    float reciprocal_size() const {
        const Lanes extents = upper - lower;
        const float extent = std::max(extents[0], std::max(extents[1], extents[2])); // may overflow
        std::uint32_t bits;
        std::memcpy(&bits, &extent, sizeof bits);
        const std::uint32_t exponent = std::min(bits >> 23, 253u);
        bits = (254u - exponent) << 23;
        float reciprocal;
        std::memcpy(&reciprocal, &bits, sizeof reciprocal);
        return reciprocal;
    }

    // In double, where the products of float32 neither over- nor underflow. Not for empty bounds.
    double half_area() const {
        const double x = static_cast<double>(upper[0]) - static_cast<double>(lower[0]);
        const double y = static_cast<double>(upper[1]) - static_cast<double>(lower[1]);
        const double z = static_cast<double>(upper[2]) - static_cast<double>(lower[2]);
        return x * y + y * z + z * x;
    }
};

// a where the condition holds, else b; without a jump.
inline Lanes select(bool condition, Lanes a, Lanes b) {
    const std::int32_t all = condition ? -1 : 0;
    const IntLanes mask{all, all, all, all};
    return reinterpret_cast<Lanes>((reinterpret_cast<IntLanes>(a) & mask) | (reinterpret_cast<IntLanes>(b) & ~mask));
}

} // namespace raywise
