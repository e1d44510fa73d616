#include "accel/grid/grid_statistics.h"

#include <algorithm>
#include <cmath>

namespace raywise {

GridStatistics grid_statistics(const std::array<std::uint32_t, 3>& resolution,
                               const std::vector<std::uint32_t>& counts) {
    GridStatistics result;
    if (counts.empty()) return result;
    result.resolution = resolution;
    result.cells = counts.size();
    for (const std::uint64_t count : counts) {
        result.references += count;
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
    for (const std::uint32_t count : counts) {
        const double distance = static_cast<double>(count) - result.mean;
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
