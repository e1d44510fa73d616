// How a kd-tree is built. The defaults are what scenes use; the others are for tests and studies, most of them as the textbooks and Chuang's lecture
// "Acceleration" have them.
#pragma once

#include <cstdint>

namespace raywise {

enum class KdSplit {
    surface_area, // where the surface area heuristic says that rays will cost least
    median,       // through the median of the primitives' middles, across the longest axis of the cell
    middle        // through the middle of the cell, across its longest axis
};

struct KdTreeOptions {
    KdSplit split = KdSplit::surface_area;

    // What a leaf's test and a step from node to node cost, in the same unit; 0: BuildCosts of the input. The lecture has 80 and 1.
    double test_cost = 0.0;
    double step_cost = 0.0;
    // So many primitives of a leaf are tested at once, at the cost of one: what a register holds. 1: each costs a test.
    std::uint32_t tested_at_once = 8;

    // The part by which a split that cuts off empty space counts as cheaper.
    double empty_bonus = 0.2;
    // Splits on one path that seem to make things worse, in the hope of a good one after them: at most so many.
    int most_bad_splits = 0;

    // Whether a primitive on both sides of a plane is cut, so that each side knows where its part ends ("perfect splits").
    bool clips = true;
    // Nodes of at most so many primitives are split at the best of all planes, larger ones at the best of some.
    std::uint32_t most_exact = 256;
    // Splits may repeat references up to so many per primitive in the whole tree.
    std::uint32_t most_references_per_primitive = 8;
    // Median and middle: nodes of at most so many primitives become leaves.
    std::uint32_t leaf_size = 8;

    // More nodes or references than so many, and there is no tree: rays test all primitives; slower, never different. Their links have 30 bits.
    std::uint64_t most_numbers = std::uint64_t{1} << 30;
};

} // namespace raywise
