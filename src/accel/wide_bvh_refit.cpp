#include "accel/wide_bvh_refit.h"

#include "accel/wide_bvh_write.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

namespace raywise {
namespace {

// Nodes that one thread fits at a time; about forty triangles each.
constexpr std::size_t nodes_per_task = 256;

class Refitter {
public:
    Refitter(const WideBvh& old, const BuildInput& input)
        : old_(old),
          primitives_(input.primitives),
          all_hittable_(primitives_.hittable_count() == primitives_.count()),
          input_(input),
          is_fit_(old.nodes.size()) {}

    WideBvh run() {
        bvh_.frame = SceneFrame(primitives_.bounds());
        bvh_.nodes = PageArray<WideNode>(old_.nodes.size());
        bvh_.words = make_words((old_.words.size() - block_size) / words_per_triangle);
        const std::size_t tasks = (old_.nodes.size() + nodes_per_task - 1) / nodes_per_task;
        input_.parallel.for_each(tasks, [&](std::uint64_t task) {
            fit_task(task * nodes_per_task, std::min(old_.nodes.size(), (task + 1) * nodes_per_task));
            const double done = static_cast<double>(++done_) / static_cast<double>(tasks);
            input_.progress.report(done, "refit");
        });
        // What is left are the nodes above those at the ends of tasks: few, as subtrees lie together.
        for (std::size_t n = old_.nodes.size(); n-- > 0;) {
            if (is_fit_[n] == 0) is_fit_[n] = fit_inner_children(n, old_.nodes.size()) ? 1 : 0;
        }
        bvh_.exact = exact_;
        bvh_.repeats = old_.repeats;
        bvh_.built_cost = old_.built_cost;
        return std::move(bvh_);
    }

private:
    // From the last node to the first, so that children come before their parents.
    void fit_task(std::size_t begin, std::size_t end) {
        LeafWriter leaves(bvh_, primitives_);
        std::vector<std::uint32_t> leaf;
        bool exact = true;
        for (std::size_t n = end; n-- > begin;) {
            const WideNode& old = old_.nodes[n];
            WideNode& node = bvh_.nodes[n];
            for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
                node.child[i] = old.child[i];
                set_absent(node, i);
                if (!is_absent(old, i) && old.child[i].is_leaf())
                    exact = fit_leaf(node, i, old.child[i], leaf, leaves) && exact;
            }
            is_fit_[n] = fit_inner_children(n, end) ? 1 : 0;
        }
        if (!exact) exact_ = false;
    }

    // Returns false when one of them is not below `end` or not fit itself.
    bool fit_inner_children(std::size_t n, std::size_t end) {
        bool complete = true;
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
            const WideReference child = old_.nodes[n].child[i];
            if (is_absent(old_.nodes[n], i) || child.is_leaf()) continue;
            if (child.index() < end && is_fit_[child.index()] != 0) {
                set_box_around(bvh_.nodes[n], i, bvh_.nodes[child.index()]);
            } else {
                complete = false;
            }
        }
        return complete;
    }

    // Returns WideBvh::exact for this leaf.
    bool fit_leaf(WideNode& node, std::uint32_t i, WideReference old, std::vector<std::uint32_t>& leaf,
                  LeafWriter& leaves) {
        read_leaf(old, leaf);
        const auto count = static_cast<std::uint32_t>(leaf.size());
        BlockWord* const words = bvh_.words.data() + words_per_triangle * old.index();
        std::fill(words + words_per_triangle * count, words + words_per_triangle * old.triangles(), BlockWord{0.0f});
        node.child[i] = count == 0 ? WideReference::node(0) : WideReference::leaf(old.index(), count);
        if (count == 0) return true;
        const WrittenLeaf written = leaves.write(old.index(), leaf.data(), count);
        set_box(node, i, written.box.lower, written.box.upper);
        return written.exact;
    }

    // The primitives of a leaf of the other tree that can be hit now.
    void read_leaf(WideReference leaf, std::vector<std::uint32_t>& primitives) const {
        primitives.clear();
        for (std::uint32_t begin = 0; begin < leaf.triangles(); begin += block_size) {
            const std::uint32_t n = std::min(block_size, leaf.triangles() - begin);
            const BlockWord* const block = old_.block(std::size_t{leaf.index()} + begin);
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t primitive = BlockTriangle{block, n, i}.primitive();
                if (all_hittable_ || primitives_.is_hittable(primitive)) primitives.push_back(primitive);
            }
        }
    }

    const WideBvh& old_;
    const Primitives& primitives_;
    const bool all_hittable_;
    const BuildInput& input_;
    WideBvh bvh_;
    std::vector<std::uint8_t> is_fit_; // a byte each: threads write to neighbours
    std::atomic<bool> exact_{true};
    std::atomic<std::uint64_t> done_{0};
};

bool could_all_be_hit(const Primitives& primitives, const Primitives& before) {
    if (before.hittable_count() == before.count()) return true;
    for (std::uint32_t i = 0; i < primitives.count(); ++i) {
        if (primitives.is_hittable(i) && !before.is_hittable(i)) return false;
    }
    return true;
}

} // namespace

std::optional<WideBvh> refit(const WideBvhScene& other, const BuildInput& input) {
    const Primitives& primitives = input.primitives;
    if (primitives.count() != other.primitives.count() || !could_all_be_hit(primitives, other.primitives))
        return std::nullopt;
    if (primitives.hittable_count() == 0) return WideBvh{};
    return Refitter(other.bvh, input).run();
}

} // namespace raywise
