#include "accel/dense_region.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace raywise {
namespace {

constexpr std::uint32_t most_sampled = 256;

std::vector<Box> sampled_boxes(const Primitives& primitives) {
    std::vector<Box> boxes;
    const std::uint32_t count = primitives.count();
    const std::uint32_t sampled = std::min(count, most_sampled);
    boxes.reserve(sampled);
    for (std::uint32_t i = 0; i < sampled; ++i) {
        const auto primitive = static_cast<std::uint32_t>(std::uint64_t{count} * i / sampled);
        if (primitives.is_hittable(primitive)) boxes.push_back(primitives.box(primitive));
    }
    return boxes;
}

double at_rank(std::vector<double>& values, std::size_t rank) {
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

} // namespace

DenseRegion dense_region(const Primitives& primitives) {
    const std::vector<Box> boxes = sampled_boxes(primitives);
    DenseRegion region;
    if (boxes.empty()) {
        if (primitives.bounds().empty()) return region;
        region.center = primitives.bounds().center();
        region.radius = max_component(primitives.bounds().size());
        region.extent = primitives.largest_extent();
        return region;
    }
    const std::size_t n = boxes.size();
    std::vector<double> values(n);
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < n; ++i) values[i] = boxes[i].center()[axis];
        const double median = at_rank(values, n / 2);
        region.center[axis] = median;
        region.radius =
            std::max({region.radius, median - at_rank(values, n / 10), at_rank(values, n - 1 - n / 10) - median});
    }
    for (std::size_t i = 0; i < n; ++i) values[i] = max_component(boxes[i].size());
    region.extent = at_rank(values, n / 2);
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
    SceneExtent extent{primitives.bounds(), primitives.largest_extent(), {}};
    for (const Box& box : sampled_boxes(primitives)) extent.middles.push_back(box.center());
    return extent;
}

SceneFrame scene_frame(const Primitives& primitives) { return scene_frame(primitives, dense_region(primitives)); }

SceneFrame scene_frame(const Primitives& primitives, const DenseRegion& dense) {
    const Vec3 center = SceneFrame::choose_center(dense.center, dense.radius);
    // Where the center is not the median, most triangles lie within this of it.
    const double radius = dense.radius + max_component(magnitudes(dense.center - center));
    return {center, radius, primitives.bounds()};
}

} // namespace raywise
