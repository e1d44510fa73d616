#include "accel/bvh_build_clusters.h"

#include "accel/bvh_build_nearest.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace raywise {
namespace {

// A round that leaves more than so much of the clusters is the last: the rest is far apart, or of very different size.
constexpr double least_shrink = 0.95;

BvhNode make_node(const float* lower, const float* upper, std::uint32_t first, std::uint32_t count) {
    BvhNode node;
    for (int axis = 0; axis < 3; ++axis) {
        node.planes[0][axis] = lower[axis];
        node.planes[1][axis] = upper[axis];
    }
    node.first = first;
    node.count = count;
    return node;
}

} // namespace

// The clusters of one range after another, with memory that is used again.
class Clusters::Range {
public:
    Range(const Clusters& owner, float scale)
        : owner_(owner),
          scale_(scale),
          boxes_(range_size),
          clusters_(make_uninitialised<BuildItem>(range_size)),
          costs_(make_uninitialised<float>(range_size)) {}

    // Returns the clusters.
    std::vector<BuildItem> build(std::uint32_t begin) {
        load(begin);
        for (int round = 0; round < most_rounds; ++round) {
            boxes_.search(count_);
            const std::uint32_t before = count_;
            merge();
            if (count_ > least_shrink * before) break;
        }
        std::vector<BuildItem> result(clusters_.get(), clusters_.get() + count_);
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
            clusters_[i] = owner_.items_[owner_.keys_[begin + i].index];
            clusters_[i].id = i;
            set_box(i);
            costs_[i] = static_cast<float>(owner_.costs_.leaf(1)) * half_area(i);
        }
    }

    void set_box(std::uint32_t i) {
        for (int axis = 0; axis < 3; ++axis) {
            boxes_.plane(axis)[i] = -clusters_[i].lower[axis] * scale_;
            boxes_.plane(3 + axis)[i] = clusters_[i].upper[axis] * scale_;
        }
    }
    float half_area(std::uint32_t i) {
        const float x = boxes_.plane(0)[i] + boxes_.plane(3)[i];
        const float y = boxes_.plane(1)[i] + boxes_.plane(4)[i];
        const float z = boxes_.plane(2)[i] + boxes_.plane(5)[i];
        return x * (y + z) + y * z;
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
                merge(i, other, kept);
            } else {
                clusters_[kept] = clusters_[i];
                costs_[kept] = costs_[i];
            }
            set_box(kept);
            ++kept;
        }
        count_ = kept;
    }

    void merge(std::uint32_t a, std::uint32_t b, std::uint32_t to) {
        Bounds bounds = Bounds::of(clusters_[a]);
        bounds.extend(Bounds::of(clusters_[b]));
        BuildItem merged;
        std::memcpy(static_cast<void*>(&merged), &bounds, sizeof bounds);
        merged.id = range_size + node_count_;
        merged.count = clusters_[a].count + clusters_[b].count;
        Node& node = owner_.nodes_[begin_ + node_count_++];
        std::copy_n(merged.lower, 3, node.lower);
        std::copy_n(merged.upper, 3, node.upper);
        node.child[0] = static_cast<std::uint16_t>(clusters_[a].id);
        node.child[1] = static_cast<std::uint16_t>(clusters_[b].id);
        node.count = static_cast<std::uint16_t>(merged.count);

        const float cost_of_children = costs_[a] + costs_[b];
        clusters_[to] = merged;
        set_box(to);
        const TreeCosts& costs = owner_.costs_;
        const float area = half_area(to);
        const float split = static_cast<float>(costs.node) * area + cost_of_children;
        const float leaf = static_cast<float>(costs.leaf(merged.count)) * area;
        node.is_leaf = merged.count <= costs.max_leaf_size && leaf <= split;
        costs_[to] = node.is_leaf ? leaf : split;
    }

    const Clusters& owner_;
    const float scale_;
    NearestBoxes boxes_;
    std::unique_ptr<BuildItem[]> clusters_;
    std::unique_ptr<float[]> costs_; // of each cluster's tree, times half areas
    std::uint32_t begin_ = 0;
    std::uint32_t count_ = 0;
    std::uint32_t node_count_ = 0;
};

void Clusters::build(const Bounds& bounds, const Parallel& parallel,
                     const std::function<void(std::uint64_t)>& report) {
    const std::uint64_t ranges = (count_ + range_size - 1) / range_size;
    nodes_ = make_uninitialised<Node>(count_);
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

void Clusters::open(const BuildItem& cluster, std::uint32_t size, std::vector<BuildItem>& parts) const {
    if (cluster.count <= size) {
        parts.push_back(cluster);
    } else {
        open(place_of(cluster), size, parts);
    }
}

void Clusters::open(const Place& place, std::uint32_t size, std::vector<BuildItem>& parts) const {
    for (const std::uint16_t number : node(place).child) {
        const Place child{place.range, number};
        BuildItem part;
        if (number < range_size) {
            part = items_[keys_[place.range + number].index];
            part.id = place.range + number;
        } else {
            const Node& n = node(child);
            if (n.count > size) {
                open(child, size, parts);
                continue;
            }
            std::copy_n(n.lower, 3, part.lower);
            std::copy_n(n.upper, 3, part.upper);
            part.id = place.range + number - range_size;
            part.count = n.count;
        }
        parts.push_back(part);
    }
}

BvhNode Clusters::emit(const BuildItem& cluster, std::vector<BvhPair>& pairs, std::uint32_t* references,
                       std::uint32_t first) const {
    return emit(place_of(cluster), pairs, references, first);
}

BvhNode Clusters::emit(const Place& place, std::vector<BvhPair>& pairs, std::uint32_t* references,
                       std::uint32_t& first) const {
    if (place.number < range_size) {
        const BuildItem& item = items_[keys_[place.range + place.number].index];
        references[first] = item.id;
        return make_node(item.lower, item.upper, first++, 1);
    }
    const Node& n = node(place);
    if (n.is_leaf) {
        const std::uint32_t begin = first;
        emit_primitives(place, references + first);
        first += n.count;
        return make_node(n.lower, n.upper, begin, n.count);
    }
    const auto pair = static_cast<std::uint32_t>(pairs.size());
    pairs.emplace_back();
    for (int child = 0; child < 2; ++child) {
        const BvhNode built = emit(Place{place.range, n.child[child]}, pairs, references, first);
        pairs[pair].child[child] = built;
    }
    return make_node(n.lower, n.upper, pair, 0);
}

std::uint32_t* Clusters::emit_primitives(const BuildItem& cluster, std::uint32_t* references) const {
    return emit_primitives(place_of(cluster), references);
}

std::uint32_t* Clusters::emit_primitives(const Place& place, std::uint32_t* references) const {
    if (place.number < range_size) {
        *references = items_[keys_[place.range + place.number].index].id;
        return references + 1;
    }
    for (const std::uint16_t child : node(place).child) {
        references = emit_primitives(Place{place.range, child}, references);
    }
    return references;
}

} // namespace raywise
