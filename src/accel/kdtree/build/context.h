// What all parts of a kd-tree's building know.
#pragma once

#include "accel/accel.h"
#include "accel/kdtree/build/binary_tree.h"
#include "accel/kdtree/build/clip.h"
#include "accel/kdtree/build/costs.h"
#include "accel/kdtree/options.h"
#include "base/page_array.h"

#include <functional>

namespace raywise {

struct KdContext {
    const KdTreeOptions& options;
    const KdCosts& costs;
    const KdClipper& clipper;
    int most_levels;
    std::function<void(std::uint64_t)> report; // called with numbers of primitives in nodes that are done

    // Whether a task cannot but become a leaf: no split costs less than its own step, whatever follows.
    bool is_leaf(std::uint32_t count, int level) const {
        return count <= 1 || level >= most_levels || costs.leaf(count) <= costs.step;
    }
};

// Nodes and references of a tree or of a part of it, as they grow.
struct KdOutput {
    PageVector<KdNode> nodes;
    PageVector<std::uint32_t> references;

    // Takes back what has been added since.
    struct Mark {
        std::size_t nodes;
        std::size_t references;
    };
    Mark mark() const { return {nodes.size(), references.size()}; }
    void go_back(const Mark& mark) {
        nodes.resize(mark.nodes);
        references.resize(mark.references);
    }

    // Makes an inner node of one that is there, and returns its first child; the other follows.
    std::uint32_t split(std::uint32_t node, int axis, float position) {
        const auto child = static_cast<std::uint32_t>(nodes.size());
        nodes.resize(nodes.size() + 2);
        nodes[node] = KdNode::inner(axis, position, child);
        return child;
    }
    void set_leaf(std::uint32_t node, const PageVector<std::uint32_t>& list) {
        nodes[node] =
            KdNode::leaf(static_cast<std::uint32_t>(references.size()), static_cast<std::uint32_t>(list.size()));
        references.insert(references.end(), list.begin(), list.end());
    }
};

} // namespace raywise
