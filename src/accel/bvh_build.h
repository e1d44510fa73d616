// The binary bounding volume hierarchy as data, and its builder.
#pragma once

#include "accel/accel.h"
#include "ray/scene_frame.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

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
    std::vector<BvhPair> pairs;
    std::vector<std::uint32_t> references; // primitives, in the order of the leaves

    bool empty() const { return references.empty(); }
    std::size_t bytes() const {
        return pairs.capacity() * sizeof(BvhPair) + references.capacity() * sizeof(std::uint32_t);
    }
};

enum class BvhQuality {
    fast, // clusters from below, split from above
    high // split from above down to the primitives, which may be cut in two, and nodes moved: slower to build, faster to trace
};

struct BvhBuildOptions {
    std::uint32_t max_leaf_size = 16;
    // Primitives that a leaf tests at once: it costs BuildCosts::primitive_test_ns for each block it begins. A
    // power of two.
    std::uint32_t block_size = 1;
    std::optional<BuildCosts> costs; // instead of the input's
    BvhQuality quality = BvhQuality::fast;
};

// Builds the tree. Fast: nearest primitives are merged from below (bvh_build_clusters.h), and the clusters split from above
// by the surface area heuristic (bvh_build_top_down.h). High: split from above down to the primitives
// (bvh_spatial_splits.h), then nodes move to where they cost less (bvh_reinsertion.h); where boxes overlap much, once more with
// primitives cut, and the better of both is taken. A primitive can then be among the references more than once. The same
// tree for any number of threads and every instruction set. Progress is reported from 0 to `progress_end`.
BvhTree build_bvh(const BuildInput& input, double progress_end = 1.0, const BvhBuildOptions& options = {});

} // namespace raywise
