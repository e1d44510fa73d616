// From the binary tree to the wide one: a node takes in its descendants, the largest first, until it has eight children.
#include "accel/bvh/build/wide.h"

#include "accel/bvh/build/bounds.h"
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

// Subtrees up to this size are widened by one thread each, what is above them by one alone. It depends on nothing but the scene, and
// neither does the order of the nodes therefore.
constexpr std::uint32_t job_size = 16384;

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
    PageVector<Extent> of_pair_;
};

using Children = std::vector<Subtree>;

class Widener {
public:
    Widener(const BvhTree& tree, const BuildInput& input, double progress_begin)
        : tree_(tree), input_(input), progress_begin_(progress_begin), extents_(tree) {}

    WideBvh run() {
        if (tree_.empty()) return std::move(bvh_);
        bvh_.frame = tree_.frame;
        make_blocks(bvh_, input_.primitives, tree_.references.size());

        top_.emplace_back();
        LeafWriter leaves(bvh_, input_.primitives);
        make_top(0, extents_.of(tree_.root), leaves);
        input_.parallel.for_each(jobs_.size(), [&](std::uint64_t i) {
            Job& job = jobs_[i];
            job.nodes.reserve(job.root.count / 16 + 1);
            job.nodes.emplace_back();
            LeafWriter leaves_of_job(bvh_, input_.primitives);
            make_node(job.nodes, 0, job.root, leaves_of_job);
            fit_inner(job.nodes.data(), job.nodes.size());
            const double part =
                static_cast<double>(done_ += job.root.count) / static_cast<double>(tree_.references.size());
            input_.progress.report(progress_begin_ + (1.0 - progress_begin_) * part, "bvh");
        });
        assemble();
        bvh_.repeats = tree_.references.size() > input_.primitives.hittable_count();
        bvh_.built_cost = tree_cost(bvh_, input_.parallel);
        return std::move(bvh_);
    }

private:
    // A subtree that a thread widens alone. Its nodes are numbered from 0 until all are assembled.
    struct Job {
        Subtree root;
        std::uint32_t parent; // the top node it hangs below, and as which child
        std::uint32_t child;
        PageVector<WideNode> nodes;
    };

    void make_top(std::uint32_t index, const Subtree& subtree, LeafWriter& leaves) {
        const Children children = choose_children(subtree);
        top_[index] = empty_node();
        for (std::uint32_t i = 0; i < children.size(); ++i) {
            const Subtree& child = children[i];
            if (is_leaf(child)) {
                set_leaf(top_[index], i, child, leaves);
            } else if (child.count <= job_size) {
                jobs_.push_back({child, index, i, {}});
            } else {
                const auto next = static_cast<std::uint32_t>(top_.size());
                top_.emplace_back();
                top_[index].child[i] = NodeRef::node(next);
                make_top(next, child, leaves);
            }
        }
    }

    // Siblings lie side by side.
    void make_node(PageVector<WideNode>& nodes, std::uint32_t index, const Subtree& subtree, LeafWriter& leaves) {
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

    static WideNode empty_node() {
        WideNode node{};
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) set_empty(node, i);
        return node;
    }

    // The boxes of inner nodes, around those of their children, which lie behind them.
    static void fit_inner(WideNode* nodes, std::size_t count) {
        for (std::size_t n = count; n-- > 0;) {
            for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
                const NodeRef child = nodes[n].child[i];
                if (is_inner_child(nodes[n], i)) set_box_around(nodes[n], i, nodes[child.index()]);
            }
        }
    }
    // Before it has a box, too: the root is nobody's child.
    static bool is_inner_child(const WideNode& node, std::uint32_t i) {
        return !node.child[i].is_leaf() && node.child[i].index() != 0;
    }

    void set_leaf(WideNode& node, std::uint32_t i, const Subtree& leaf, LeafWriter& leaves) {
        const LeafWriter::Leaf written = leaves.write(leaf.first, &tree_.references[leaf.first], leaf.count);
        node.child[i] = written.reference;
        // The tree's boxes are relative to the frame's center already.
        const auto& planes = leaf.node->planes;
        const Vec3f lower(planes[0][0], planes[0][1], planes[0][2]);
        const Vec3f upper(planes[1][0], planes[1][1], planes[1][2]);
        const double scale = bvh_.frame.scale();
        set_leaf_box(node, i, scale * Vec3(lower), scale * Vec3(upper), written.extent());
    }

    void assemble() {
        std::vector<std::uint32_t> offsets;
        offsets.reserve(jobs_.size());
        std::size_t total = top_.size();
        for (const Job& job : jobs_) {
            offsets.push_back(static_cast<std::uint32_t>(total));
            top_[job.parent].child[job.child] = NodeRef::node(offsets.back());
            total += job.nodes.size();
        }
        bvh_.nodes = PageArray<WideNode>(total);
        std::copy(top_.begin(), top_.end(), bvh_.nodes.begin());
        input_.parallel.for_each(jobs_.size(), [&](std::uint64_t i) {
            WideNode* const nodes = bvh_.nodes.data() + offsets[i];
            std::copy(jobs_[i].nodes.begin(), jobs_[i].nodes.end(), nodes);
            for (std::size_t k = 0; k < jobs_[i].nodes.size(); ++k) {
                for (NodeRef& child : nodes[k].child) {
                    if (!child.is_leaf()) child = NodeRef::node(child.index() + offsets[i]);
                }
            }
            jobs_[i].nodes = {};
        });
        fit_inner(bvh_.nodes.data(), top_.size());
    }

    const BvhTree& tree_;
    const BuildInput& input_;
    const double progress_begin_;
    const Extents extents_;
    WideBvh bvh_;
    PageVector<WideNode> top_;
    std::vector<Job> jobs_;
    std::atomic<std::uint64_t> done_{0};
};

} // namespace

WideBvh widen(const BvhTree& tree, const BuildInput& input, double progress_begin) {
    return Widener(tree, input, progress_begin).run();
}

} // namespace raywise
