#include "geometry/corner_tree.h"

#include <algorithm>
#include <numeric>

namespace raywise {

void CornerTree::build(const std::vector<Vec2>& points) {
    const auto count = static_cast<std::uint32_t>(points.size());
    std::uint32_t leaves = 1;
    while (static_cast<std::uint64_t>(leaves) * leaf_size < count) leaves *= 2;
    first_leaf_ = leaves - 1;
    nodes_.resize(2 * static_cast<std::size_t>(leaves) - 1);
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0u);
    leaf_of_.resize(count);
    on_.assign(count, 0);
    fill(0, 0, count, points);
}

void CornerTree::fill(std::uint32_t index, std::uint32_t first, std::uint32_t end, const std::vector<Vec2>& points) {
    Node& node = nodes_[index];
    node = {points[order_[first]], points[order_[first]], first, end, 0};
    for (std::uint32_t i = first; i < end; ++i) {
        node.lower = glm::min(node.lower, points[order_[i]]);
        node.upper = glm::max(node.upper, points[order_[i]]);
    }
    if (index >= first_leaf_) {
        for (std::uint32_t i = first; i < end; ++i) leaf_of_[order_[i]] = index;
        return;
    }
    // Where extents are beyond float64 either axis will do.
    const int axis = node.upper.x - node.lower.x >= node.upper.y - node.lower.y ? 0 : 1;
    const std::uint32_t middle = first + (end - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return at(points[a], axis) < at(points[b], axis); });
    fill(2 * index + 1, first, middle, points);
    fill(2 * index + 2, middle, end, points);
}

} // namespace raywise
