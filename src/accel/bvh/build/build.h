// The builder of binary bounding volume hierarchies.
#pragma once

#include "accel/accel.h"
#include "accel/bvh/binary_tree.h"

#include <cstdint>
#include <optional>

namespace raywise {

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

// Builds the tree. Fast: nearest primitives are merged from below (clusters.h), and the clusters split from above
// by the surface area heuristic (top_down.h). High: split from above down to the primitives
// (spatial_splits.h), then nodes move to where they cost less (reinsertion.h); where boxes overlap much, once more with
// primitives cut, and the better of both is taken. A primitive can then be among the references more than once. The same
// tree for any number of threads and every instruction set. Progress is reported from 0 to `progress_end`.
BvhTree build_bvh(const BuildInput& input, double progress_end = 1.0, const BvhBuildOptions& options = {});

} // namespace raywise
