#include "accel/dense_region.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace raywise {
namespace {

std::vector<Vec3> sampled_middles(const Primitives& primitives, std::uint32_t most_sampled) {
    std::vector<Vec3> middles;
    const std::uint32_t count = primitives.count();
    const std::uint32_t sampled = std::min(count, most_sampled);
    middles.reserve(sampled);
    for (std::uint32_t i = 0; i < sampled; ++i) {
        const auto primitive = static_cast<std::uint32_t>(std::uint64_t{count} * i / sampled);
        if (primitives.is_hittable(primitive)) middles.push_back(primitives.box(primitive).center());
    }
    return middles;
}

double at_rank(std::vector<double>& values, std::size_t rank) {
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

} // namespace

DenseRegion dense_region(const Primitives& primitives, std::uint32_t most_sampled) {
    const std::vector<Vec3> middles = sampled_middles(primitives, most_sampled);
    DenseRegion region;
    if (middles.empty()) {
        const Box bounds = primitives.outer_bounds();
        if (bounds.empty()) return region;
        region.center = bounds.center();
        region.radius = max_component(bounds.size());
        return region;
    }
    const std::size_t n = middles.size();
    std::vector<double> values(n);
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < n; ++i) values[i] = middles[i][axis];
        const double median = at_rank(values, n / 2);
        region.center[axis] = median;
        region.radius =
            std::max({region.radius, median - at_rank(values, n / 10), at_rank(values, n - 1 - n / 10) - median});
    }
    return region;
}

double SceneExtent::near_distance(const Vec3& point) const {
    if (middles.empty()) return std::numeric_limits<double>::infinity();
    std::vector<double> distances;
    distances.reserve(middles.size());
    for (const Vec3& middle : middles) distances.push_back(max_component(magnitudes(middle - point)));
    return at_rank(distances, distances.size() / 10);
}

SceneExtent scene_extent(const Primitives& primitives) {
    return {primitives.bounds(), primitives.largest_extent(), sampled_middles(primitives, usual_sample)};
}

SceneFrame scene_frame(const Primitives& primitives, std::uint32_t most_sampled) {
    const DenseRegion dense = dense_region(primitives, most_sampled);
    const Vec3 center = SceneFrame::choose_center(dense.center, dense.radius);
    // Where the center is not the median, most triangles lie within this of it.
    const double radius = dense.radius + max_component(magnitudes(dense.center - center));
    return {center, radius, primitives.outer_bounds()};
}

} // namespace raywise
