// How the primitives of a scene are spread over the cells of its grid: the figures that Hapala, Karlik and Havran 2011
// ("When It Makes Sense to Use Uniform Grids for Ray Tracing", equations 1 to 6) propose for judging a scene.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace raywise {

// N_i is the number of references in cell i, t the number of cells. All zero for a grid without cells.
struct GridStatistics {
    std::array<std::uint32_t, 3> resolution{};
    std::uint64_t cells = 0;
    std::uint64_t empty_cells = 0;
    std::uint64_t references = 0;
    std::uint64_t max_references = 0; // eq. 2: the fullest cell
    double sparseness = 0.0;          // eq. 1: empty cells / cells (the paper's N means the number of cells here)
    double mean = 0.0;                // eq. 3: references / cells
    double variance = 0.0;            // eq. 4: divided by t - 1; 0 for a single cell
    double standard_deviation = 0.0;
    double skewness = 0.0; // eq. 5: third standardized moment, over t; 0 when all cells hold the same number
    double kurtosis = 0.0; // eq. 6: fourth standardized moment, over t, minus 3; 0 when all cells hold the same number
};

// counts: the references of each cell, in any order. Allocates nothing.
GridStatistics grid_statistics(const std::array<std::uint32_t, 3>& resolution,
                               const std::vector<std::uint32_t>& counts);

} // namespace raywise
