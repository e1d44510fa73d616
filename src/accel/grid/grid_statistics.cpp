#include "accel/grid/grid_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace raywise {

GridStatistics grid_statistics(const std::array<std::uint32_t, 3>& resolution,
                               const std::vector<std::uint32_t>& offsets) {
    GridStatistics result;
    if (offsets.size() < 2) return result;
    result.resolution = resolution;
    result.cells = offsets.size() - 1;
    result.references = offsets.back() - offsets.front();
    for (std::size_t i = 0; i < result.cells; ++i) {
        const std::uint64_t count = offsets[i + 1] - offsets[i];
        result.empty_cells += count == 0 ? 1 : 0;
        result.max_references = std::max(result.max_references, count);
    }
    const auto t = static_cast<double>(result.cells);
    result.sparseness = static_cast<double>(result.empty_cells) / t;
    result.mean = static_cast<double>(result.references) / t;

    // The second pass sums powers of the distance from a mean that is already known to the last place: sums of plain
    // powers would cancel.
    double square = 0.0;
    double cube = 0.0;
    double fourth = 0.0;
    for (std::size_t i = 0; i < result.cells; ++i) {
        const double distance = static_cast<double>(offsets[i + 1] - offsets[i]) - result.mean;
        const double squared = distance * distance;
        square += squared;
        cube += squared * distance;
        fourth += squared * squared;
    }
    if (result.cells == 1 || square == 0.0) return result;
    result.variance = square / (t - 1.0);
    result.standard_deviation = std::sqrt(result.variance);
    result.skewness = cube / t / (result.variance * result.standard_deviation);
    result.kurtosis = fourth / t / (result.variance * result.variance) - 3.0;
    return result;
}

} // namespace raywise
