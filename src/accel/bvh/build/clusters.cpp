#include "accel/bvh/build/clusters.h"

#include "accel/bvh/build/nearest.h"

#include <algorithm>
#include <cstring>

namespace raywise {
namespace {

// A round that leaves more than so much of the clusters is the last: the rest is far apart, or of very different size.
constexpr double least_shrink = 0.95;

} // namespace

// The clusters of one range after another, with memory that is used again.
class Clusters::Range {
public:
    Range(Clusters& owner, float scale)
        : owner_(owner), scale_(fill_lanes(scale)), boxes_(range_size), clusters_(PageArray<BuildItem>(range_size)) {}

    // Returns the clusters.
    std::vector<BuildItem> build(std::uint32_t begin) {
        load(begin);
        for (int round = 0; round < most_rounds; ++round) {
            copy_boxes();
            boxes_.search(count_);
            const std::uint32_t before = count_;
            merge();
            if (count_ > least_shrink * before) break;
        }
        std::vector<BuildItem> result(clusters_.data(), clusters_.data() + count_);
        for (BuildItem& cluster : result) {
            cluster.id = begin + (cluster.count > 1 ? cluster.id - range_size : cluster.id);
        }
        return result;
    }

private:
    // The ids of clusters are their numbers within the range here.
    void load(std::uint32_t begin) {
        begin_ = begin;
        count_ = std::min(owner_.count_ - begin, range_size);
        node_count_ = 0;
        for (std::uint32_t i = 0; i < count_; ++i) {
            MortonKey& key = owner_.keys_[begin + i];
            clusters_[i] = owner_.items_[key.index];
            key.code = clusters_[i].id;
            clusters_[i].id = i;
        }
    }

    // Four boxes at a time, from lower and upper corners to planes. Up to three that are not there go where the search
    // wants nothing to be.
    void copy_boxes() {
        for (std::uint32_t i = 0; i < count_; i += 4) {
            Lanes lower[4];
            Lanes upper[4];
            for (std::uint32_t k = 0; k < 4; ++k) {
                const Bounds box = Bounds::of(clusters_[std::min(i + k, count_ - 1)]);
                lower[k] = -(box.lower * scale_);
                upper[k] = box.upper * scale_;
            }
            copy_planes(lower, 0, i);
            copy_planes(upper, 3, i);
        }
    }
    void copy_planes(const Lanes (&corners)[4], int first_plane, std::uint32_t i) {
        Lanes axes[3];
        to_axes(corners, axes);
        for (int axis = 0; axis < 3; ++axis)
            std::memcpy(boxes_.plane(first_plane + axis) + i, &axes[axis], sizeof axes[axis]);
    }

    // Two that chose each other become one, where the first of them was. The others move up.
    void merge() {
        std::uint32_t kept = 0;
        for (std::uint32_t i = 0; i < count_; ++i) {
            const std::int32_t offset = boxes_.offset(i);
            const std::uint32_t other = i + static_cast<std::uint32_t>(offset);
            const bool mutual = offset != 0 && boxes_.offset(other) == -offset;
            if (mutual && offset < 0) continue;
            if (mutual) {
                clusters_[kept] = merged(clusters_[i], clusters_[other]);
            } else {
                clusters_[kept] = clusters_[i];
            }
            ++kept;
        }
        count_ = kept;
    }

    BuildItem merged(const BuildItem& a, const BuildItem& b) {
        Bounds bounds = Bounds::of(a);
        bounds.extend(Bounds::of(b));
        BuildItem result = bounds.item(range_size + node_count_, a.count + b.count);
        Node& node = owner_.nodes_[begin_ + node_count_++];
        static_assert(sizeof node == sizeof result);
        std::memcpy(&node, &result, sizeof node);
        node.child[0] = static_cast<std::uint16_t>(a.id);
        node.child[1] = static_cast<std::uint16_t>(b.id);
        return result;
    }

    Clusters& owner_;
    const Lanes scale_;
    NearestBoxes boxes_;
    PageArray<BuildItem> clusters_;
    std::uint32_t begin_ = 0;
    std::uint32_t count_ = 0;
    std::uint32_t node_count_ = 0;
};

void Clusters::build(const Bounds& bounds, const Parallel& parallel, const std::function<void(std::uint64_t)>& report) {
    const std::uint64_t ranges = (count_ + range_size - 1) / range_size;
    nodes_ = PageArray<Node>(count_);
    std::vector<std::vector<BuildItem>> tops(ranges);
    const float scale = bounds.reciprocal_size();
    parallel.for_blocks(ranges, 1, [&](std::uint64_t begin, std::uint64_t end) {
        Range range(*this, scale);
        for (std::uint64_t r = begin; r < end; ++r) {
            tops[r] = range.build(static_cast<std::uint32_t>(r * range_size));
            report(std::min<std::uint64_t>(range_size, count_ - r * range_size));
        }
    });
    std::size_t total = 0;
    for (const auto& part : tops) total += part.size();
    tops_.reserve(total);
    for (auto& part : tops) {
        tops_.insert(tops_.end(), part.begin(), part.end());
        part = {};
    }
}

void Clusters::release() {
    items_ = {};
    keys_ = {};
    nodes_ = {};
    tops_ = {};
}

void Clusters::open(const BuildItem& cluster, std::vector<BuildItem>& parts) const {
    if (cluster.count <= 2) {
        parts.push_back(cluster);
    } else {
        open(range_of(cluster), node(cluster), parts);
    }
}

void Clusters::open(std::uint32_t range, const Node& opened, std::vector<BuildItem>& parts) const {
    for (const std::uint16_t number : opened.child) {
        BuildItem part;
        if (number < range_size) {
            part = items_[keys_[range + number].index];
            part.id = range + number;
        } else {
            const std::uint32_t id = range + number - range_size;
            const Node& child = nodes_[id];
            if (child.count > 2) {
                open(range, child, parts);
                continue;
            }
            std::memcpy(static_cast<void*>(&part), &child, sizeof part);
            part.id = id;
        }
        parts.push_back(part);
    }
}

std::array<const BuildItem*, 2> Clusters::references(const BuildItem& cluster) const {
    if (cluster.count == 1) return {&items_[keys_[cluster.id].index], nullptr};
    const std::uint32_t range = range_of(cluster);
    const Node& n = node(cluster);
    return {&items_[keys_[range + n.child[0]].index], &items_[keys_[range + n.child[1]].index]};
}

std::uint32_t* Clusters::emit_primitives(const BuildItem& cluster, std::uint32_t* primitives) const {
    if (cluster.count == 1) {
        *primitives = keys_[cluster.id].code;
        return primitives + 1;
    }
    const std::uint32_t range = range_of(cluster);
    for (const std::uint16_t number : node(cluster).child) *primitives++ = keys_[range + number].code;
    return primitives;
}

} // namespace raywise
