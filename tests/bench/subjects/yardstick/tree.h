// The yardstick's hierarchy: nodes of eight boxes, leaves of blocks of triangles, all in float32 as the mesh has them.
#pragma once

#include "base/page_array.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

namespace raywise::bench {
namespace { // compiled more than once, for different processors

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t node_width = 8;
using Doubles = hn::CappedTag<double, 8>;
constexpr std::size_t block_size = hn::MaxLanes(Doubles());

// A child is a node's index, or with this flag that of a block: one is a leaf.
constexpr std::uint32_t leaf_flag = 0x80000000u;

struct alignas(64) Node {
    float planes[6][node_width]; // lower x, upper x, lower y ...; of children that are not there, in the wrong order
    std::uint32_t child[node_width];
};

struct alignas(32) Block {
    float corner[3][3][block_size]; // corner, axis; NaN where there is no triangle
    std::uint32_t id[block_size];
    float extent; // largest coordinate
};

struct Tree {
    PageArray<Node> nodes; // the root first
    PageArray<Block> blocks;
};

// How many nodes lie above each other at most; build_tree throws where more would.
constexpr std::size_t most_levels = 64;

} // namespace
} // namespace raywise::bench
