// What a hierarchy is built to keep low.
#pragma once

#include "accel/bvh/build/build.h"

#include <cstdint>

namespace raywise {

// What the surface area heuristic (Goldsmith and Salmon 1987, MacDonald and Booth 1990) takes a tree to cost: a ray that
// meets a node meets what is in it with the ratio of their areas as probability.
struct TreeCosts {
    double node;              // a step to both children of a node
    double block;             // a test of up to block_size primitives of a leaf
    std::uint32_t block_size; // a power of two
    int log2_block_size;
    std::uint32_t max_leaf_size; // a larger node is split even where the heuristic would rather test all its primitives

    TreeCosts(const BuildInput& input, const BvhBuildOptions& options)
        : node(options.costs.value_or(input.costs).node_step_ns),
          block(options.costs.value_or(input.costs).primitive_test_ns),
          block_size(options.block_size),
          log2_block_size(log2_of(options.block_size)),
          max_leaf_size(options.max_leaf_size) {}

    std::uint32_t blocks(std::uint32_t primitives) const { return (primitives + (block_size - 1)) >> log2_block_size; }
    double leaf(std::uint32_t primitives) const { return block * blocks(primitives); }

private:
    static int log2_of(std::uint32_t power) {
        int log = 0;
        while ((std::uint32_t{1} << log) < power) ++log;
        return log;
    }
};

} // namespace raywise
