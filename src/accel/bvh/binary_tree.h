// The binary bounding volume hierarchy as data: what builders make, and what is widened or traversed.
#pragma once

#include "base/page_array.h"
#include "ray/scene_frame.h"

#include <cstddef>
#include <cstdint>

namespace raywise {

// No node lies deeper, so a traversal that pushes at most one node per level needs no more entries.
inline constexpr int bvh_max_depth = 64;

// 32 bytes: a float32 box, rounded outwards, relative to the frame's center; and what is inside.
struct BvhNode {
    float planes[2][3];  // lower and upper corner, so that a ray picks its entry planes by the signs of its direction
    std::uint32_t first; // leaf: its first reference; otherwise the pair of its children
    std::uint32_t count; // references of a leaf; 0: not a leaf

    bool is_leaf() const { return count > 0; }
};

// Siblings are always looked at together: one cache line.
struct alignas(64) BvhPair {
    BvhNode child[2];
};

// A pair's index is above that of the pair its parent is in. Without any primitive that can be hit all is empty, the
// root too.
struct BvhTree {
    SceneFrame frame; // boxes are relative to its center, and not scaled
    BvhNode root{};
    PageVector<BvhPair> pairs;
    PageVector<std::uint32_t> references; // primitives, in the order of the leaves

    bool empty() const { return references.empty(); }
    std::size_t bytes() const {
        return pairs.capacity() * sizeof(BvhPair) + references.capacity() * sizeof(std::uint32_t);
    }
};

} // namespace raywise
