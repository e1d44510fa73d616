// The lower levels of a hierarchy, built from below.
#pragma once

#include "accel/bvh_build.h"
#include "accel/bvh_build_bounds.h"
#include "accel/bvh_build_costs.h"
#include "accel/bvh_build_morton.h"
#include "base/parallel.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace raywise {

// Clusters of primitives that lie close together, each a binary tree: parallel locally-ordered clustering (Meister and
// Bittner 2018) over ranges of the references' Morton order. Every cluster looks for its nearest among its neighbours on
// the curve, and two that chose each other become one. Ranges are clustered on their own, each by one thread and within
// its cache; since there remain many clusters of a range that its ends touch only few of, that is hardly felt. What is
// far from all others, or has no place on the curve, stays alone: the top-down builder above takes clusters as they come.
class Clusters {
public:
    // References of a range.
    static constexpr std::uint32_t range_size = 2048;

    // No tree of a cluster is deeper: a round adds one level at most.
    static constexpr int most_rounds = 3;

    // items, keys: the references and their order; they have to outlive this.
    Clusters(const BuildItem* items, const MortonKey* keys, std::uint32_t count, const TreeCosts& costs)
        : items_(items), keys_(keys), count_(count), costs_(costs) {}

    // report: called with numbers of references that are done.
    void build(const Bounds& bounds, const Parallel& parallel, const std::function<void(std::uint64_t)>& report);

    // One item for each cluster, along the curve; id names the cluster.
    std::vector<BuildItem>& items() { return tops_; }

    // Appends the smaller clusters that a cluster was merged from: the largest ones of at most `size` primitives.
    void open(const BuildItem& cluster, std::uint32_t size, std::vector<BuildItem>& parts) const;

    // Appends the pairs of a cluster's tree to `pairs`, writes its primitives to references[first] and on, and returns
    // its root.
    BvhNode emit(const BuildItem& cluster, std::vector<BvhPair>& pairs, std::uint32_t* references,
                 std::uint32_t first) const;
    // Writes a cluster's primitives only. Returns where the next ones go.
    std::uint32_t* emit_primitives(const BuildItem& cluster, std::uint32_t* references) const;

private:
    // Two merged clusters. Within a range the numbers below range_size are references, from there on nodes.
    struct Node {
        float lower[3];
        std::uint16_t child[2];
        float upper[3];
        std::uint16_t count; // of primitives
        bool is_leaf;
    };
    // A reference or node of a range.
    struct Place {
        std::uint32_t range; // its first reference
        std::uint32_t number;
    };

    static Place place_of(const BuildItem& cluster) {
        const std::uint32_t range = cluster.id / range_size * range_size;
        return {range, cluster.id - range + (cluster.count > 1 ? range_size : 0)};
    }
    const Node& node(const Place& place) const { return nodes_[place.range + place.number - range_size]; }
    void open(const Place& place, std::uint32_t size, std::vector<BuildItem>& parts) const;
    BvhNode emit(const Place& place, std::vector<BvhPair>& pairs, std::uint32_t* references,
                 std::uint32_t& first) const;
    std::uint32_t* emit_primitives(const Place& place, std::uint32_t* references) const;

    class Range;

    const BuildItem* const items_;
    const MortonKey* const keys_;
    const std::uint32_t count_;
    const TreeCosts costs_;
    std::unique_ptr<Node[]> nodes_; // of each range, from the number of its first reference on
    std::vector<BuildItem> tops_;
};

} // namespace raywise
