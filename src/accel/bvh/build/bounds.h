// Boxes while a hierarchy is built: in float32, four lanes wide.
#pragma once

#include "accel/bvh/binary_tree.h"
#include "base/box.h"
#include "base/lanes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

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

struct Bounds {
    Lanes lower;
    Lanes upper;

    RW_INLINE static Bounds none() {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        return {fill_lanes(infinity), fill_lanes(-infinity)};
    }
    // The lanes of the item's numbers become zero: most are denormal as floats, and arithmetic on those is slow.
    RW_INLINE static Bounds of(const BuildItem& item) {
        IntLanes bits[2];
        std::memcpy(bits, &item, sizeof bits);
        const IntLanes box{-1, -1, -1, 0};
        return {reinterpret_cast<Lanes>(bits[0] & box), reinterpret_cast<Lanes>(bits[1] & box)};
    }
    RW_INLINE BuildItem item(std::uint32_t id, std::uint32_t count) const {
        BuildItem result;
        std::memcpy(static_cast<void*>(&result), this, sizeof *this);
        result.id = id;
        result.count = count;
        return result;
    }
    // Of the centroid alone: BuildItem::centroid on each axis.
    RW_INLINE static Bounds of_centroid(const BuildItem& item) {
        const Lanes c = of(item).centroid();
        return {c, c};
    }
    RW_INLINE Lanes centroid() const { return 0.5f * lower + 0.5f * upper; } // does not overflow

    RW_INLINE void extend(const Bounds& other) {
        lower = min_lanes(other.lower, lower);
        upper = max_lanes(other.upper, upper);
    }

    // What to multiply with for the largest extent to become about one: a power of two, and a normal number.
    RW_INLINE float reciprocal_size() const {
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

inline int longest_axis(const Bounds& bounds) {
    const Lanes extent = bounds.upper - bounds.lower;
    const int xy = extent[0] >= extent[1] ? 0 : 1;
    return extent[xy] >= extent[2] ? xy : 2;
}

inline Bounds bounds_of(const BoxF& box) {
    return {Lanes{box.lower.x, box.lower.y, box.lower.z, 0.0f}, Lanes{box.upper.x, box.upper.y, box.upper.z, 0.0f}};
}

inline Bounds bounds_of(const BvhNode& node) {
    return {Lanes{node.planes[0][0], node.planes[0][1], node.planes[0][2], 0.0f},
            Lanes{node.planes[1][0], node.planes[1][1], node.planes[1][2], 0.0f}};
}

// first and count as in BvhNode.
inline BvhNode make_node(const Bounds& bounds, std::uint32_t first, std::uint32_t count) {
    BvhNode node;
    for (int axis = 0; axis < 3; ++axis) {
        node.planes[0][axis] = bounds.lower[axis];
        node.planes[1][axis] = bounds.upper[axis];
    }
    node.first = first;
    node.count = count;
    return node;
}

} // namespace raywise
