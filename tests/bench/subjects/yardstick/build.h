// Builds the yardstick's tree in one thread: binned splits by surface area from the top (Wald 2007), straight into nodes of eight.
#pragma once

#include "bench/subjects/yardstick/tree.h"
#include "scenes/scenes.h"

#include "base/vec.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace raywise::bench {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float not_there = std::numeric_limits<float>::quiet_NaN();

struct Bounds {
    Vec3f lower = Vec3f(infinite), upper = Vec3f(-infinite);

    void extend(const Bounds& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
    void extend(const Vec3f& point) { extend(Bounds{point, point}); }
    Vec3f center() const { return 0.5f * lower + 0.5f * upper; }
    float area() const {
        const Vec3f size = upper - lower;
        return size.x < 0.0f ? 0.0f : size.x * size.y + size.y * size.z + size.z * size.x;
    }
};

struct BoundedTriangle {
    Bounds bounds;
    std::uint32_t id;
};

struct Range {
    std::size_t begin, end;
    Bounds bounds, centers;

    std::size_t size() const { return end - begin; }
};

class TreeBuilder {
public:
    explicit TreeBuilder(const workloads::Mesh& mesh) : mesh_(mesh) {
        for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
            Bounds bounds;
            for (std::size_t k = 0; k < 3; ++k) bounds.extend(corner(i, k));
            triangles_.push_back({bounds, i});
        }
    }

    Tree build() {
        const Range all = range(0, triangles_.size());
        if (all.size() > block_size) {
            add_node(all, 1);
        } else {
            nodes_.push_back(empty_node());
            if (all.size() > 0) set_child(nodes_.front(), 0, all, add_leaf(all));
        }
        return {in_pages(nodes_), in_pages(blocks_)};
    }

private:
    static constexpr std::size_t bins = 32;

    template <class T>
    static PageArray<T> in_pages(const std::vector<T>& values) {
        PageArray<T> pages(values.size());
        std::copy(values.begin(), values.end(), pages.begin());
        return pages;
    }

    Vec3f corner(std::uint32_t triangle, std::size_t k) const {
        const float* const v = &mesh_.vertices[3 * std::size_t{mesh_.indices[3 * std::size_t{triangle} + k]}];
        return {v[0], v[1], v[2]};
    }

    Range range(std::size_t begin, std::size_t end) const {
        Range range{begin, end, {}, {}};
        for (std::size_t i = begin; i < end; ++i) {
            range.bounds.extend(triangles_[i].bounds);
            range.centers.extend(triangles_[i].bounds.center());
        }
        return range;
    }

    static std::size_t blocks_of(std::size_t triangles) { return (triangles + block_size - 1) / block_size; }

    static std::size_t bin_of(const BoundedTriangle& triangle, const Range& range, int axis) {
        const float from = range.centers.lower[axis];
        const float part = (triangle.bounds.center()[axis] - from) / (range.centers.upper[axis] - from);
        return std::min(static_cast<std::size_t>(part * static_cast<float>(bins)), bins - 1);
    }

    struct Split {
        int axis = -1; // none
        std::size_t bin = 0;
        float cost = infinite;
    };

    void find_split(const Range& range, int axis, Split& best) const {
        Bounds bounds[bins];
        std::size_t counts[bins] = {};
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const std::size_t bin = bin_of(triangles_[i], range, axis);
            bounds[bin].extend(triangles_[i].bounds);
            ++counts[bin];
        }
        float cost_above[bins];
        Bounds swept;
        std::size_t count = 0;
        for (std::size_t bin = bins; bin-- > 1;) {
            swept.extend(bounds[bin]);
            count += counts[bin];
            cost_above[bin] = swept.area() * static_cast<float>(blocks_of(count));
        }
        swept = {};
        count = 0;
        for (std::size_t bin = 1; bin < bins; ++bin) {
            swept.extend(bounds[bin - 1]);
            count += counts[bin - 1];
            const float cost = swept.area() * static_cast<float>(blocks_of(count)) + cost_above[bin];
            if (count > 0 && count < range.size() && cost < best.cost) best = {axis, bin, cost};
        }
    }

    std::pair<Range, Range> split(const Range& whole) {
        Split best;
        for (int axis = 0; axis < 3; ++axis) {
            if (whole.centers.upper[axis] > whole.centers.lower[axis]) find_split(whole, axis, best);
        }
        std::size_t middle = whole.begin + whole.size() / 2; // where all have one center
        if (best.axis >= 0) {
            const auto first = triangles_.begin() + static_cast<std::ptrdiff_t>(whole.begin);
            const auto last = triangles_.begin() + static_cast<std::ptrdiff_t>(whole.end);
            const auto place = std::partition(first, last, [&](const BoundedTriangle& triangle) {
                return bin_of(triangle, whole, best.axis) < best.bin;
            });
            middle = static_cast<std::size_t>(place - triangles_.begin());
        }
        return {range(whole.begin, middle), range(middle, whole.end)};
    }

    static Node empty_node() {
        Node node{};
        for (std::size_t plane = 0; plane < 6; ++plane)
            std::fill_n(node.planes[plane], node_width, plane % 2 == 0 ? infinite : -infinite);
        return node;
    }

    static void set_child(Node& node, std::size_t i, const Range& range, std::uint32_t child) {
        for (int axis = 0; axis < 3; ++axis) {
            node.planes[2 * axis][i] = range.bounds.lower[axis];
            node.planes[2 * axis + 1][i] = range.bounds.upper[axis];
        }
        node.child[i] = child;
    }

    std::uint32_t add_leaf(const Range& range) {
        const std::size_t first = blocks_.size();
        if (first >= leaf_flag) throw std::runtime_error("too many triangles for the yardstick");
        Block block{};
        for (std::size_t i = 0; i < block_size; ++i) {
            const bool there = range.begin + i < range.end;
            block.id[i] = there ? triangles_[range.begin + i].id : 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3f point = there ? corner(block.id[i], k) : Vec3f(not_there);
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    block.corner[k][axis][i] = point[static_cast<int>(axis)];
                    if (there) block.extent = std::max(block.extent, std::abs(point[static_cast<int>(axis)]));
                }
            }
        }
        blocks_.push_back(block);
        return leaf_flag | static_cast<std::uint32_t>(first);
    }

    // Of more triangles than a leaf takes. The largest box is split until there are eight.
    std::uint32_t add_node(const Range& whole, std::size_t level) {
        if (level > most_levels) throw std::runtime_error("too deep a tree for the yardstick");
        Range children[node_width] = {whole};
        std::size_t count = 1;
        while (count < node_width) {
            Range* largest = nullptr;
            for (Range& child : children) {
                if (child.size() > block_size && (largest == nullptr || child.bounds.area() > largest->bounds.area()))
                    largest = &child;
            }
            if (largest == nullptr) break;
            std::tie(*largest, children[count]) = split(*largest);
            ++count;
        }
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back(empty_node());
        for (std::size_t i = 0; i < count; ++i) {
            const Range& child = children[i];
            const std::uint32_t reference = child.size() > block_size ? add_node(child, level + 1) : add_leaf(child);
            set_child(nodes_[index], i, child, reference);
        }
        return index;
    }

    const workloads::Mesh& mesh_;
    std::vector<BoundedTriangle> triangles_;
    std::vector<Node> nodes_;
    std::vector<Block> blocks_;
};

} // namespace
} // namespace raywise::bench
