#include "accel/bvh/build/morton_tree.h"

#include "accel/bvh/build/morton_ranges.h"
#include "accel/bvh/build/subtrees.h"
#include "accel/bvh/write.h"
#include "accel/dense_region.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

namespace raywise {
namespace {

// Below this depth ranges are halved whatever their codes, so that none of at most 2^32 primitives needs more than eleven levels more: each
// divides by eight, down to leaves of eight.
constexpr int most_depth_of_codes = bvh_max_depth - 11;

// A range of so few triangles becomes a leaf where its node has no room left to divide it: two blocks take no longer than a node and what is
// left of its leaves. With leaves of at most 8 / 12 / 16 the dragon takes 44 / 41 / 39 ns per triangle, nodes take 15 / 10 / 8 bytes of it,
// and rays are as fast. AMD EPYC, 2026-12-01.
constexpr std::uint32_t largest_leaf = 16;

// Corners are asked for by so many triangles at a time. Without it the dragon takes 57 ns per triangle, with 128 / 512 / 1,024 / 2,048 it takes
// 53 / 49 / 45 / 46; what fits the second-level cache takes as long. AMD EPYC, 2026-12-01.
constexpr std::uint32_t prefetched = 1024;

bool is_leaf(const MortonRange& range) { return range.count() <= largest_leaf; }

class MortonBuilder {
public:
    explicit MortonBuilder(const BuildInput& input)
        : input_(input),
          report_([this](std::uint64_t primitives) { report(primitives); }),
          dense_(dense_region(input.primitives)),
          frame_(scene_frame(input.primitives, dense_)),
          ranges_(input, frame_, dense_, report_) {}

    WideBvh run() {
        bvh_.frame = frame_;
        make_blocks(bvh_, input_.primitives, input_.primitives.hittable_count());
        top_.push_back(empty_node());
        LeafWriter leaves(bvh_, input_.primitives);
        make_top_node(0, {ranges_.all(), 0}, leaves);
        input_.parallel.for_each(subtrees_.size(), [&](std::uint64_t i) {
            std::vector<WideNode>& nodes = subtrees_[i].nodes;
            const Part& root = roots_[i];
            nodes.reserve(root.range.count() / 24 + 1);
            LeafWriter leaves_of_subtree(bvh_, input_.primitives);
            make_node(nodes, root, leaves_of_subtree);
            report(root.range.count());
        });
        bvh_.nodes = assemble(std::move(top_), subtrees_, input_.parallel);
        bvh_.built_cost = tree_cost(bvh_, input_.parallel);
        return std::move(bvh_);
    }

private:
    // What becomes a node.
    struct Part {
        MortonRange range;
        int depth;
    };
    struct Children {
        MortonRange ranges[wide_bvh_width];
        std::uint32_t count = 1;
    };
    // What a node says of a child.
    struct Child {
        NodeRef reference;
        Bounds box;
    };

    // Each primitive is reported twice: with its code, and in a leaf.
    void report(std::uint64_t primitives) {
        const double done = static_cast<double>(done_ += primitives);
        const double all = 2.0 * static_cast<double>(input_.primitives.hittable_count());
        input_.progress.report(std::min(1.0, done / all), "bvh");
    }

    // What is largest in space is divided first.
    Children choose_children(const Part& part) {
        const bool by_codes = part.depth < most_depth_of_codes;
        Children children;
        children.ranges[0] = part.range;
        std::uint64_t priorities[wide_bvh_width] = {priority(part.range, by_codes, 0)};
        while (children.count < wide_bvh_width) {
            const std::uint64_t highest = *std::max_element(priorities, priorities + wide_bvh_width);
            if (highest == 0) break;
            const auto i = static_cast<std::uint32_t>(highest % wide_bvh_width);
            const std::uint32_t k = children.count++;
            std::tie(children.ranges[i], children.ranges[k]) =
                by_codes ? ranges_.divide(children.ranges[i]) : ranges_.halve(children.ranges[i]);
            priorities[i] = priority(children.ranges[i], by_codes, i);
            priorities[k] = priority(children.ranges[k], by_codes, k);
        }
        return children;
    }

    // By level, then by number, in one number with the place as lowest digit: no jump depends on codes. Zero for what stays whole.
    static std::uint64_t priority(const MortonRange& range, bool by_codes, std::uint32_t place) {
        const std::uint64_t level = by_codes ? range.level : 0;
        return range.count() <= triangle_block_size ? 0 : (level << 32 | range.count()) * wide_bvh_width + place;
    }

    void make_top_node(std::uint32_t index, const Part& part, LeafWriter& leaves) {
        const Children children = choose_children(part);
        for (std::uint32_t i = 0; i < children.count; ++i) {
            const Part child{children.ranges[i], part.depth + 1};
            if (is_leaf(child.range)) {
                const Child leaf = make_leaf(child.range, leaves);
                top_[index].child[i] = leaf.reference;
                set_box(top_[index], i, leaf.box);
            } else if (child.range.count() <= subtree_size) {
                roots_.push_back(child);
                subtrees_.push_back({index, i, {}});
            } else {
                const auto next = static_cast<std::uint32_t>(top_.size());
                top_.push_back(empty_node());
                top_[index].child[i] = NodeRef::node(next);
                make_top_node(next, child, leaves);
            }
        }
    }

    Child make_node(std::vector<WideNode>& nodes, const Part& part, LeafWriter& leaves) {
        const auto index = static_cast<std::uint32_t>(nodes.size());
        nodes.emplace_back();
        const Children children = choose_children(part);
        NodeRef references[wide_bvh_width];
        Bounds boxes[wide_bvh_width];
        Bounds all = Bounds::none();
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
            references[i] = NodeRef::node(0);
            boxes[i] = empty_box();
            if (i >= children.count) continue;
            const MortonRange& range = children.ranges[i];
            if (range.count() <= prefetched && part.range.count() > prefetched) prefetch(range, leaves);
            const Child child =
                is_leaf(range) ? make_leaf(range, leaves) : make_node(nodes, {range, part.depth + 1}, leaves);
            references[i] = child.reference;
            boxes[i] = child.box;
            all.extend(child.box);
        }
        set_boxes(nodes[index], boxes);
        std::copy(references, references + wide_bvh_width, nodes[index].child);
        return {NodeRef::node(index), all};
    }

    void prefetch(const MortonRange& range, LeafWriter& leaves) const {
        std::uint32_t primitives[prefetched];
        for (std::uint32_t i = 0; i < range.count(); ++i) primitives[i] = ranges_.primitive(range.begin + i);
        leaves.prefetch(primitives, range.count());
    }

    Child make_leaf(const MortonRange& range, LeafWriter& leaves) {
        std::uint32_t primitives[largest_leaf]; // the last one again in the place of those that are not there
        for (std::uint32_t i = 0; i < largest_leaf; ++i)
            primitives[i] = ranges_.primitive(std::min(range.begin + i, range.end - 1));
        const LeafWriter::Leaf leaf = leaves.write(range.begin, primitives, range.count());
        return {leaf.reference, leaf.box};
    }

    const BuildInput& input_;
    const std::function<void(std::uint64_t)> report_;
    std::atomic<std::uint64_t> done_{0};
    const DenseRegion dense_;
    const SceneFrame frame_;
    MortonRanges ranges_;
    WideBvh bvh_;
    std::vector<WideNode> top_;
    std::vector<NodeSubtree> subtrees_;
    std::vector<Part> roots_; // of the subtrees
};

} // namespace

WideBvh build_morton_tree(const BuildInput& input) {
    if (input.primitives.hittable_count() == 0) return {};
    return MortonBuilder(input).run();
}

} // namespace raywise
