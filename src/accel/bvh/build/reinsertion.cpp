#include "accel/bvh/build/reinsertion.h"

#include "accel/bvh/build/bounds.h"
#include "base/page_array.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace raywise {
namespace {

constexpr std::uint32_t root = 0;

// The search for one node's place looks at no more nodes than that. On average it looks at 15 (scanned meshes) to 150; 1000 take
// less than 0.01 % more off the cost.
constexpr int most_steps = 200;

// Less, as a part of the node's own area, is rounding.
constexpr double least_gain = 1e-6;

// One cache line.
struct alignas(64) Node {
    Bounds box;
    double area; // half of it
    std::uint32_t parent;
    std::uint32_t child[2]; // of a leaf: its first reference, and their number
    std::uint16_t height;   // levels below it
    bool is_leaf;
};
static_assert(sizeof(Node) == 64);

struct Move {
    std::uint32_t node;
    std::uint32_t target; // becomes its sibling
    double gain;          // what the areas of all inner nodes become less by
};

double area_of_both(const Bounds& a, const Bounds& b) {
    Bounds both = a;
    both.extend(b);
    return both.half_area();
}

// The tree with ways up, so that nodes can be moved. A node keeps its index wherever it is.
class LinkedTree {
public:
    explicit LinkedTree(const BvhTree& tree) : nodes_(2 * tree.pairs.size() + 1) {
        take_apart(tree, tree.root, root, root);
    }

    std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
    const Node& operator[](std::uint32_t index) const { return nodes_[index]; }
    std::uint32_t sibling(std::uint32_t index) const { return other_child(nodes_[index].parent, index); }
    std::uint32_t other_child(std::uint32_t parent, std::uint32_t child) const {
        const Node& node = nodes_[parent];
        return node.child[node.child[0] == child ? 1 : 0];
    }

    double cost(const TreeCosts& costs) const {
        double sum = 0.0;
        for (const Node& node : nodes_) sum += node.area * (node.is_leaf ? costs.leaf(node.child[1]) : costs.node);
        return sum;
    }

    // Makes a node the target's sibling. Their parent will be the one that the node has now, which leaves its place to the
    // node's present sibling.
    void move(std::uint32_t index, std::uint32_t target) {
        const std::uint32_t parent = nodes_[index].parent;
        const std::uint32_t left_alone = sibling(index);
        replace_child(nodes_[parent].parent, parent, left_alone);
        fit_upwards(nodes_[left_alone].parent);
        replace_child(nodes_[target].parent, target, parent);
        nodes_[parent].child[0] = target;
        nodes_[parent].child[1] = index;
        nodes_[target].parent = parent;
        fit(nodes_[parent]);
        fit_upwards(nodes_[parent].parent);
    }

    // Pairs and references in the order of depth.
    void write(BvhTree& tree) const {
        PageVector<BvhPair> pairs;
        PageVector<std::uint32_t> references;
        pairs.reserve(tree.pairs.size());
        references.reserve(tree.references.size());
        tree.root = write(root, tree.references, pairs, references);
        tree.pairs = std::move(pairs);
        tree.references = std::move(references);
    }

private:
    void take_apart(const BvhTree& tree, const BvhNode& from, std::uint32_t index, std::uint32_t parent) {
        Node& node = nodes_[index];
        node.parent = parent;
        node.is_leaf = from.is_leaf();
        if (from.is_leaf()) {
            node.box = bounds_of(from);
            node.area = node.box.half_area();
            node.child[0] = from.first;
            node.child[1] = from.count;
            node.height = 0;
            return;
        }
        for (std::uint32_t i = 0; i < 2; ++i) {
            node.child[i] = 2 * from.first + i + 1;
            take_apart(tree, tree.pairs[from.first].child[i], node.child[i], index);
        }
        node.box = Bounds::none(); // which no node has: fit() compares
        node.height = 0;
        fit(node);
    }

    // Returns whether that changed the node.
    bool fit(Node& node) {
        const Node& a = nodes_[node.child[0]];
        const Node& b = nodes_[node.child[1]];
        Bounds box = a.box;
        box.extend(b.box);
        const auto height = static_cast<std::uint16_t>(1 + std::max(a.height, b.height));
        const IntLanes same = (box.lower == node.box.lower) & (box.upper == node.box.upper);
        if (height == node.height && same[0] != 0 && same[1] != 0 && same[2] != 0) return false;
        node.box = box;
        node.area = box.half_area();
        node.height = height;
        return true;
    }
    void fit_upwards(std::uint32_t index) {
        while (fit(nodes_[index]) && index != root) index = nodes_[index].parent;
    }

    void replace_child(std::uint32_t parent, std::uint32_t child, std::uint32_t by) {
        Node& node = nodes_[parent];
        node.child[node.child[0] == child ? 0 : 1] = by;
        nodes_[by].parent = parent;
    }

    BvhNode write(std::uint32_t index, const PageVector<std::uint32_t>& from, PageVector<BvhPair>& pairs,
                  PageVector<std::uint32_t>& references) const {
        const Node& node = nodes_[index];
        if (node.is_leaf) {
            const auto first = static_cast<std::uint32_t>(references.size());
            const auto begin = from.begin() + node.child[0];
            references.insert(references.end(), begin, begin + node.child[1]);
            return make_node(node.box, first, node.child[1]);
        }
        const auto pair = static_cast<std::uint32_t>(pairs.size());
        pairs.emplace_back();
        for (std::size_t i = 0; i < 2; ++i) {
            const BvhNode child = write(node.child[i], from, pairs, references);
            pairs[pair].child[i] = child;
        }
        return make_node(node.box, pair, 0);
    }

    PageArray<Node> nodes_;
};

// The best place of a node, by branch and bound: up from its parent, and at each node on the way down into the other child.
class Search {
public:
    Search(const LinkedTree& tree, std::uint32_t index)
        : tree_(tree), node_(tree[index]), best_{index, index, least_gain * node_.area} {}

    // The target is the node itself where no place is better than its own.
    Move run() {
        std::uint32_t from = best_.node;
        std::uint32_t above = node_.parent;
        Bounds rest = tree_[tree_.sibling(from)].box; // of what is below `above` without the node
        removed_ = tree_[above].area;                 // the parent is taken out as well
        for (;;) {
            const std::uint32_t other = tree_.other_child(above, from);
            search_below(other);
            if (above == root || steps_ >= most_steps) return best_;
            if (above != node_.parent) {
                rest.extend(tree_[other].box);
                const double area = tree_[above].area;
                removed_ += area - rest.half_area();
                consider(above, removed_ - area); // beside what is left of it
            }
            from = above;
            above = tree_[above].parent;
        }
    }

private:
    struct Entry {
        std::uint32_t node;
        double growth; // of the nodes above it, together
    };

    void search_below(std::uint32_t start) {
        // Of each level one waits.
        std::array<Entry, bvh_max_depth + 2> stack;
        std::size_t height = 0;
        stack[height++] = {start, 0.0};
        while (height > 0 && steps_ < most_steps) {
            const Entry entry = stack[--height];
            if (!may_gain(entry.growth)) continue;
            ++steps_;
            const Node& target = tree_[entry.node];
            const double both = area_of_both(target.box, node_.box);
            consider(entry.node, removed_ - entry.growth - both);
            const double growth = entry.growth + (both - target.area);
            if (target.is_leaf || !may_gain(growth)) continue;
            stack[height++] = {target.child[0], growth};
            stack[height++] = {target.child[1], growth};
        }
    }

    // A parent of the node is at least as large as the node.
    bool may_gain(double growth) const { return removed_ - growth - node_.area > best_.gain; }

    void consider(std::uint32_t target, double gain) {
        if (gain > best_.gain) best_ = {best_.node, target, gain};
    }

    const LinkedTree& tree_;
    const Node& node_;
    Move best_;
    double removed_ = 0.0; // what the nodes that lose the node become less by
    int steps_ = 0;
};

// From a node up to the root.
class Path {
public:
    Path(const LinkedTree& tree, std::uint32_t from) {
        for (std::uint32_t index = from;; index = tree[index].parent) {
            nodes_[static_cast<std::size_t>(size_++)] = index;
            if (index == root) return;
        }
    }
    int size() const { return size_; }
    std::uint32_t operator[](int i) const { return nodes_[static_cast<std::size_t>(i)]; }
    bool contains(std::uint32_t index) const {
        return std::find(nodes_.begin(), nodes_.begin() + size_, index) != nodes_.begin() + size_;
    }

private:
    std::array<std::uint32_t, bvh_max_depth + 1> nodes_;
    int size_ = 0;
};

// What a move gains in the tree as it is now; zero where it cannot be made.
double gain_of(const LinkedTree& tree, const Move& move) {
    const Node& node = tree[move.node];
    // A child of the root would leave its sibling as the root.
    if (node.parent == root || move.target == node.parent || move.target == tree.sibling(move.node)) return 0.0;
    const Path to(tree, move.target);
    if (to.contains(move.node)) return 0.0;
    const int depth = to.size() - 1;
    if (depth + 1 + std::max(node.height, tree[move.target].height) > bvh_max_depth) return 0.0;

    // What is above both does not change. i and j: the last nodes of the ways down that do.
    const Path from(tree, node.parent);
    int i = from.size() - 1;
    int j = to.size() - 1;
    for (; i >= 0 && j >= 0 && from[i] == to[j]; --i) --j;

    double gain = tree[node.parent].area;
    Bounds rest = tree[tree.sibling(move.node)].box;
    const auto shrink = [&](int k) {
        rest.extend(tree[tree.sibling(from[k - 1])].box);
        return tree[from[k]].area - rest.half_area();
    };
    for (int k = 1; k <= i; ++k) gain += shrink(k);
    if (j < 0) return gain + shrink(i + 1) - tree[move.target].area; // the target is above the node
    gain -= area_of_both(tree[move.target].box, node.box);
    for (int k = 1; k <= j; ++k) gain -= area_of_both(tree[to[k]].box, node.box) - tree[to[k]].area;
    return gain;
}

// Returns what the areas of all inner nodes became less by. report: called now and then, so that a build can be stopped.
double run_pass(LinkedTree& tree, const Parallel& parallel, const std::function<void(std::uint64_t)>& report) {
    PageVector<Move> moves(tree.size() - 1); // of all nodes but the root
    parallel.for_blocks(moves.size(), 256, [&](std::uint64_t begin, std::uint64_t end) {
        report(0);
        for (std::uint64_t i = begin; i < end; ++i) {
            const auto index = static_cast<std::uint32_t>(i + 1);
            moves[i] = tree[index].parent == root ? Move{index, index, 0.0} : Search(tree, index).run();
        }
    });
    moves.erase(std::remove_if(moves.begin(), moves.end(), [](const Move& move) { return move.target == move.node; }),
                moves.end());
    std::sort(moves.begin(), moves.end(),
              [](const Move& a, const Move& b) { return a.gain > b.gain || (a.gain == b.gain && a.node < b.node); });
    double sum = 0.0;
    for (const Move& move : moves) {
        const double gain = gain_of(tree, move);
        if (!(gain > least_gain * tree[move.node].area)) continue;
        tree.move(move.node, move.target);
        sum += gain;
    }
    return sum;
}

} // namespace

double optimise_by_reinsertion(BvhTree& tree, const TreeCosts& costs, const Parallel& parallel,
                               const std::function<void(std::uint64_t)>& report) {
    if (tree.empty()) return 0.0;
    LinkedTree linked(tree);
    double cost = linked.cost(costs);
    for (int pass = 0; pass < most_reinsertion_passes; ++pass) {
        const double gain = costs.node * run_pass(linked, parallel, report);
        cost -= gain;
        if (!(gain >= least_reinsertion_gain * (cost + gain))) break;
    }
    linked.write(tree);
    return cost;
}

} // namespace raywise
