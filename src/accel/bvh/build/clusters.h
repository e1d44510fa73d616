// The lower levels of a hierarchy, built from below.
#pragma once

#include "accel/bvh/build/bounds.h"
#include "accel/bvh/build/morton.h"
#include "base/page_array.h"
#include "base/parallel.h"

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
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

    // Each leaves about two thirds of the clusters. Figures: docs/decisions/0011-bvh-builders.md.
    static constexpr int most_rounds = 3;

    // items: the references. keys: their order.
    Clusters(PageArray<BuildItem> items, PageArray<MortonKey> keys, std::uint32_t count)
        : items_(std::move(items)), keys_(std::move(keys)), count_(count) {}

    // report: called with numbers of references that are done.
    void build(const Bounds& bounds, const Parallel& parallel, const std::function<void(std::uint64_t)>& report);

    // One item for each cluster, along the curve; id names the cluster.
    PageVector<BuildItem>& items() { return tops_; }

    // Appends what a cluster was merged from: the largest clusters of at most two primitives.
    void open(const BuildItem& cluster, PageVector<BuildItem>& parts) const;

    // The references that a cluster of at most two primitives is made of.
    std::array<const BuildItem*, 2> references(const BuildItem& cluster) const;
    // Writes the primitives of such a cluster. Returns where the next ones go.
    std::uint32_t* emit_primitives(const BuildItem& cluster, std::uint32_t* primitives) const;

    // Gives the memory back. Nothing can be asked any more.
    void release();

private:
    // Two merged clusters. Within a range the numbers below range_size are references, from there on nodes.
    struct Node {
        float lower[3];
        std::uint16_t child[2];
        float upper[3];
        std::uint32_t count; // of primitives
    };

    class Range;

    void open(std::uint32_t range, const Node& node, PageVector<BuildItem>& parts) const;
    // Of a merged cluster.
    const Node& node(const BuildItem& cluster) const { return nodes_[cluster.id]; }
    static std::uint32_t range_of(const BuildItem& cluster) { return cluster.id / range_size * range_size; }

    PageArray<BuildItem> items_;
    PageArray<MortonKey> keys_; // the codes make room for the primitives
    const std::uint32_t count_;
    PageArray<Node> nodes_; // of each range, from the number of its first reference on
    PageVector<BuildItem> tops_;
};

} // namespace raywise
