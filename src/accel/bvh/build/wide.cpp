// From the binary tree to the wide one: a node takes in its descendants, the largest first, until it has eight children.
#include "accel/bvh/build/wide.h"

#include "accel/bvh/build/bounds.h"
#include "accel/bvh/build/subtrees.h"
#include "accel/bvh/write.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>
#include <vector>

namespace raywise {
namespace {

// A subtree of so few triangles becomes a leaf: eight are tested in one go, and two halves of a full block are seldom full.
constexpr std::uint32_t leaf_size = 6;

// A node of the binary tree, and the references below it.
struct Subtree {
    const BvhNode* node;
    std::uint32_t first;
    std::uint32_t count;
};

// How many references are below each node.
class Extents {
public:
    explicit Extents(const BvhTree& tree) : tree_(tree), of_pair_(tree.pairs.size()) {
        // A pair's index is above that of the pair its parent is in.
        for (std::size_t i = tree.pairs.size(); i-- > 0;) {
            const Subtree left = of(tree.pairs[i].child[0]);
            const Subtree right = of(tree.pairs[i].child[1]);
            of_pair_[i] = {left.first, left.count + right.count};
        }
    }
    Subtree of(const BvhNode& node) const {
        if (node.is_leaf()) return {&node, node.first, node.count};
        return {&node, of_pair_[node.first].first, of_pair_[node.first].count};
    }
    Subtree child(const BvhNode& node, int i) const { return of(tree_.pairs[node.first].child[i]); }

private:
    struct Extent {
        std::uint32_t first;
        std::uint32_t count;
    };

    const BvhTree& tree_;
    std::vector<Extent> of_pair_;
};

using Children = std::vector<Subtree>;

class Widener {
public:
    Widener(const BvhTree& tree, const BuildInput& input, double progress_begin)
        : tree_(tree), input_(input), progress_begin_(progress_begin), extents_(tree) {}

    WideBvh run() {
        if (tree_.empty()) return std::move(bvh_);
        bvh_.frame = tree_.frame;
        bvh_.repeats = tree_.references.size() > input_.primitives.hittable_count();
        make_blocks(bvh_, input_.primitives, tree_.references.size());

        top_.emplace_back();
        LeafWriter leaves(bvh_, input_.primitives);
        make_top(0, extents_.of(tree_.root), leaves);
        input_.parallel.for_each(subtrees_.size(), [&](std::uint64_t i) {
            const Subtree& root = roots_[i];
            std::vector<WideNode>& nodes = subtrees_[i].nodes;
            nodes.reserve(root.count / 16 + 1);
            nodes.emplace_back();
            LeafWriter leaves_of_subtree(bvh_, input_.primitives);
            make_node(nodes, 0, root, leaves_of_subtree);
            fit_inner_children(nodes.data(), nodes.size());
            const double part = static_cast<double>(done_ += root.count) / static_cast<double>(tree_.references.size());
            input_.progress.report(progress_begin_ + (1.0 - progress_begin_) * part, "bvh");
        });
        bvh_.nodes = assemble(std::move(top_), subtrees_, input_.parallel);
        bvh_.built_cost = tree_cost(bvh_, input_.parallel);
        return std::move(bvh_);
    }

private:
    void make_top(std::uint32_t index, const Subtree& subtree, LeafWriter& leaves) {
        const Children children = choose_children(subtree);
        top_[index] = empty_node();
        for (std::uint32_t i = 0; i < children.size(); ++i) {
            const Subtree& child = children[i];
            if (is_leaf(child)) {
                set_leaf(top_[index], i, child, leaves);
            } else if (child.count <= subtree_size) {
                roots_.push_back(child);
                subtrees_.push_back({index, i, {}});
            } else {
                const auto next = static_cast<std::uint32_t>(top_.size());
                top_.emplace_back();
                top_[index].child[i] = NodeRef::node(next);
                make_top(next, child, leaves);
            }
        }
    }

    // Siblings lie side by side.
    void make_node(std::vector<WideNode>& nodes, std::uint32_t index, const Subtree& subtree, LeafWriter& leaves) {
        const Children children = choose_children(subtree);
        nodes[index] = empty_node();
        auto next = static_cast<std::uint32_t>(nodes.size());
        for (std::uint32_t i = 0; i < children.size(); ++i) {
            if (is_leaf(children[i])) {
                set_leaf(nodes[index], i, children[i], leaves);
            } else {
                nodes[index].child[i] = NodeRef::node(next++);
            }
        }
        nodes.resize(next);
        for (std::uint32_t i = 0; i < children.size(); ++i) {
            const NodeRef child = nodes[index].child[i];
            if (!child.is_leaf()) make_node(nodes, child.index(), children[i], leaves);
        }
    }

    static bool is_leaf(const Subtree& subtree) { return subtree.count <= leaf_size || subtree.node->is_leaf(); }

    // What costs a ray most is opened first: inner nodes by their area, and while there is room leaves, by their area times the number
    // of triangles, which are then split in two.
    Children choose_children(const Subtree& subtree) const {
        Children children;
        children.reserve(wide_bvh_width);
        children.push_back(subtree);
        while (children.size() < wide_bvh_width) {
            std::size_t best = children.size();
            bool best_is_leaf = true;
            double best_cost = -1.0;
            for (std::size_t i = 0; i < children.size(); ++i) {
                const Subtree& child = children[i];
                if (child.node->is_leaf()) continue;
                const bool leaf = is_leaf(child);
                const double cost = bounds_of(*child.node).half_area() * (leaf ? child.count : 1.0);
                if (leaf == best_is_leaf ? cost > best_cost : best_is_leaf) {
                    best = i;
                    best_is_leaf = leaf;
                    best_cost = cost;
                }
            }
            if (best == children.size()) break;
            const BvhNode& opened = *children[best].node;
            children[best] = extents_.child(opened, 0);
            children.push_back(extents_.child(opened, 1));
        }
        return children;
    }

    void set_leaf(WideNode& node, std::uint32_t i, const Subtree& leaf, LeafWriter& leaves) {
        const LeafWriter::Leaf written = leaves.write(leaf.first, &tree_.references[leaf.first], leaf.count);
        node.child[i] = written.reference;
        set_box(node, i, bvh_.repeats ? box_of_parts(*leaf.node, written.extent) : written.box);
    }

    // Of a leaf with triangles that were cut: smaller than they are.
    Bounds box_of_parts(const BvhNode& leaf, double extent) const {
        // The tree's boxes are relative to the frame's center already.
        const Bounds box = bounds_of(leaf);
        const double scale = bvh_.frame.scale();
        return leaf_box({round_down(scale * __builtin_convertvector(box.lower, DoubleLanes)),
                         round_up(scale * __builtin_convertvector(box.upper, DoubleLanes))},
                        extent);
    }

    const BvhTree& tree_;
    const BuildInput& input_;
    const double progress_begin_;
    const Extents extents_;
    WideBvh bvh_;
    std::vector<WideNode> top_;
    std::vector<NodeSubtree> subtrees_;
    std::vector<Subtree> roots_; // of the subtrees
    std::atomic<std::uint64_t> done_{0};
};

} // namespace

WideBvh widen(const BvhTree& tree, const BuildInput& input, double progress_begin) {
    return Widener(tree, input, progress_begin).run();
}

} // namespace raywise
