#include "accel/bvh/refit.h"

#include "accel/bvh/write.h"
#include "accel/dense_region.h"

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
        bvh_.frame = scene_frame(primitives_);
        bvh_.nodes = PageArray<WideNode>(old_.nodes.size());
        make_blocks(bvh_, primitives_, old_.triangle_count());
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
        bvh_.repeats = old_.repeats;
        bvh_.built_cost = old_.built_cost;
        return std::move(bvh_);
    }

private:
    // From the last node to the first, so that children come before their parents.
    void fit_task(std::size_t begin, std::size_t end) {
        LeafWriter leaves(bvh_, primitives_);
        std::vector<std::uint32_t> leaf;
        for (std::size_t n = end; n-- > begin;) {
            const WideNode& old = old_.nodes[n];
            WideNode& node = bvh_.nodes[n];
            for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
                node.child[i] = old.child[i];
                set_empty(node, i);
                if (!is_empty_child(old, i) && old.child[i].is_leaf()) fit_leaf(node, i, old.child[i], leaf, leaves);
            }
            is_fit_[n] = fit_inner_children(n, end) ? 1 : 0;
        }
    }

    // Returns false when one of them is not below `end` or not fit itself.
    bool fit_inner_children(std::size_t n, std::size_t end) {
        bool complete = true;
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
            const NodeRef child = old_.nodes[n].child[i];
            if (is_empty_child(old_.nodes[n], i) || child.is_leaf()) continue;
            if (child.index() < end && is_fit_[child.index()] != 0) {
                set_box_around(bvh_.nodes[n], i, bvh_.nodes[child.index()]);
            } else {
                complete = false;
            }
        }
        return complete;
    }

    void fit_leaf(WideNode& node, std::uint32_t i, NodeRef old, std::vector<std::uint32_t>& leaf, LeafWriter& leaves) {
        read_leaf(old, leaf);
        const auto count = static_cast<std::uint32_t>(leaf.size());
        const std::size_t size = bvh_.bytes_per_triangle();
        std::byte* const blocks = bvh_.blocks.data() + size * old.index();
        std::fill(blocks + size * count, blocks + size * old.triangles(), std::byte{});
        node.child[i] = NodeRef::node(0);
        if (count == 0) return;
        const LeafWriter::Leaf written = leaves.write(old.index(), leaf.data(), count);
        node.child[i] = written.reference;
        set_box(node, i, written.box);
    }

    // The primitives of a leaf of the other tree that can be hit now.
    void read_leaf(NodeRef leaf, std::vector<std::uint32_t>& primitives) const {
        primitives.clear();
        const auto read = [&](const auto& block) {
            for (std::uint32_t i = 0; i < block.n; ++i) {
                const std::uint32_t primitive = block.id(i);
                if (all_hittable_ || primitives_.is_hittable(primitive)) primitives.push_back(primitive);
            }
        };
        if (old_.is_float64) {
            for_each_block<double>(old_, leaf, read);
        } else {
            for_each_block<float>(old_, leaf, read);
        }
    }

    const WideBvh& old_;
    const Primitives& primitives_;
    const bool all_hittable_;
    const BuildInput& input_;
    WideBvh bvh_;
    std::vector<std::uint8_t> is_fit_; // a byte each: threads write to neighbours
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

std::optional<WideBvh> refit(const WideBvh& other, const Primitives& others, const BuildInput& input) {
    const Primitives& primitives = input.primitives;
    if (primitives.count() != others.count() || !could_all_be_hit(primitives, others)) return std::nullopt;
    if (primitives.hittable_count() == 0) return WideBvh{};
    return Refitter(other, input).run();
}

} // namespace raywise
