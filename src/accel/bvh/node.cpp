#include "accel/bvh/node.h"

#include "accel/bvh/write.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace raywise {
namespace {

// Nodes whose costs are added up in one go: the same number whatever the threads, so that the sum is the same too.
constexpr std::size_t nodes_per_sum = 4096;

// Of the box of a child, in the coordinates of the frame.
double half_area(const WideNode& node, std::uint32_t i) {
    double size[3];
    for (int axis = 0; axis < 3; ++axis)
        size[axis] = static_cast<double>(node.planes[axis][1][i]) - static_cast<double>(node.planes[axis][0][i]);
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

} // namespace

double tree_cost(const WideBvh& bvh, const Parallel& parallel) {
    if (bvh.nodes.empty()) return 0.0;
    std::vector<double> sums((bvh.nodes.size() + nodes_per_sum - 1) / nodes_per_sum);
    parallel.for_each(sums.size(), [&](std::uint64_t k) {
        double sum = 0.0;
        const std::size_t end = std::min(bvh.nodes.size(), (k + 1) * nodes_per_sum);
        for (std::size_t n = k * nodes_per_sum; n < end; ++n) {
            const WideNode& node = bvh.nodes[n];
            for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
                if (is_empty_child(node, i)) continue;
                const NodeRef child = node.child[i];
                const std::uint32_t blocks = (child.triangles() + (triangle_block_size - 1)) / triangle_block_size;
                sum += half_area(node, i) * (child.is_leaf() ? blocks : 1.0);
            }
        }
        sums[k] = sum;
    });
    WideNode whole;
    set_box_around(whole, 0, bvh.nodes[0]);
    const double area = half_area(whole, 0);
    const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    return area > 0.0 ? 1.0 + sum / area : 1.0;
}

} // namespace raywise
