// What builders of grids can be told; the default is what the library uses, the rest is for tests and studies.
#pragma once

#include <cstdint>
#include <optional>

namespace raywise {

// Which triangles are held against each cell of their bounding box's; the others are listed in all of them.
enum class OverlapTest {
    none,
    large, // those that reach over more than two cells along some axis
    all
};

struct GridOptions {
    std::optional<double> density; // cells per primitive; empty: by the rays that are expected
    OverlapTest overlap_test = OverlapTest::large;
    bool mailboxes = true;
    // More references than that are counted in 64 bits.
    std::uint64_t max_narrow_references = 0xFFFFFFF0u;
};

} // namespace raywise
