#include "accel/kdtree/build/build.h"

#include "accel/dense_region.h"
#include "accel/kdtree/build/item_builder.h"
#include "accel/kdtree/build/items.h"
#include "accel/kdtree/treelets.h"
#include "base/page_array.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

namespace raywise {
namespace {

constexpr int most_levels(std::uint64_t primitives) {
    int bits = 0;
    while (bits < 32 && (std::uint64_t{1} << (bits + 1)) <= primitives) ++bits;
    return 8 + (13 * bits) / 10; // the lecture's 8 + 1.3 log2 N
}
static_assert(most_levels(1u << 30) < most_kd_levels);

// Nodes of at most so many primitives, or of a certain part of all, are built apart from each other, by any number of threads.
constexpr std::uint64_t least_apart = 4096;
constexpr std::uint64_t parts_wanted = 64;

// How much is done, in primitives of nodes, and when to say so.
class WorkReport {
public:
    WorkReport(Progress& progress, double expected, double end) : progress_(progress), expected_(expected), end_(end) {}

    void operator()(std::uint64_t primitives) {
        constexpr std::uint64_t step = 1u << 16;
        const std::uint64_t before = done_.fetch_add(primitives, std::memory_order_relaxed);
        if (before != 0 && (before + primitives) / step == before / step) return;
        progress_.report(end_ * std::min(1.0, static_cast<double>(before) / expected_), "kd-tree");
    }

private:
    Progress& progress_;
    const double expected_;
    const double end_;
    std::atomic<std::uint64_t> done_{0};
};

// References that the leaves of a tree may have: so many times the primitives, and what there is memory for, but at least one for each.
std::uint64_t most_references(const BuildInput& input, const KdTreeOptions& options) {
    const std::uint64_t primitives = input.primitives.hittable_count();
    const std::uint64_t most = primitives * options.most_references_per_primitive + 64;
    if (input.memory_limit == 0) return most;
    constexpr std::uint64_t bytes_around = 24; // of treelets and heads of leaves, for each reference
    const std::uint64_t affordable =
        input.memory_limit / (block_bytes_per_triangle(!input.primitives.is_float32()) + bytes_around);
    return std::clamp(affordable, primitives, most);
}

KdTask root_task(const PageVector<BuildItem>& items, std::uint64_t allowance) {
    Bounds bounds = Bounds::none();
    for (const BuildItem& item : items) bounds.extend(Bounds::of(item));
    KdTask root{};
    for (int axis = 0; axis < 3; ++axis) {
        root.cell.lower[axis] = static_cast<double>(bounds.lower[axis]);
        root.cell.upper[axis] = static_cast<double>(bounds.upper[axis]);
    }
    root.count = static_cast<std::uint32_t>(items.size());
    root.allowance = allowance;
    return root;
}

// Puts a finished part in its place: its root replaces the node that waits for it, the rest goes behind all.
void join(KdTreeData& tree, std::uint32_t place, KdOutput part) {
    const auto moved = static_cast<std::uint32_t>(tree.nodes.size()) - 1; // the part's root is not moved with it
    const auto first = static_cast<std::uint32_t>(tree.references.size());
    for (KdNode& node : part.nodes) {
        if (node.is_leaf()) {
            node.move_first(first);
        } else {
            node.move_child(moved);
        }
    }
    tree.nodes[place] = part.nodes.front();
    tree.nodes.insert(tree.nodes.end(), part.nodes.begin() + 1, part.nodes.end());
    tree.references.insert(tree.references.end(), part.references.begin(), part.references.end());
}

KdTreeData too_large(const SceneFrame& frame) {
    KdTreeData tree;
    tree.frame = frame;
    tree.too_large = true;
    return tree;
}

} // namespace

KdTreeData build_kd_tree(const BuildInput& input, const KdTreeOptions& options, double progress_end) {
    const std::uint64_t hittable = input.primitives.hittable_count();
    if (hittable == 0) return {};
    const SceneFrame frame = scene_frame(input.primitives);
    if (hittable >= options.most_numbers) return too_large(frame);

    const auto n = static_cast<double>(hittable);
    WorkReport work(input.progress, n * (1.0 + 1.5 * std::log2(n + 1.0)), progress_end);
    const auto report = [&work](std::uint64_t primitives) { work(primitives); };
    PageVector<BuildItem> items = gather_kd_items(input, frame, report);

    const KdCosts costs(input.costs, options);
    const KdClipper clipper(input.primitives, frame, options.clips);
    const KdContext context{options, costs, clipper, most_levels(hittable), report};
    const KdTask root = root_task(items, most_references(input, options));
    PageVector<KdPart> parts;
    const auto part_size = static_cast<std::uint32_t>(std::max(least_apart, hittable / parts_wanted));
    KdOutput top = KdItemBuilder(context, std::move(items)).build_top(root, part_size, parts);

    PageVector<KdOutput> outputs(parts.size());
    input.parallel.for_each(parts.size(), [&](std::uint64_t i) {
        const KdTask task = parts[i].task;
        outputs[i] = KdItemBuilder(context, std::move(parts[i].items)).build(task);
    });
    std::uint64_t nodes = top.nodes.size();
    std::uint64_t references = top.references.size();
    for (const KdOutput& output : outputs) {
        nodes += output.nodes.size();
        references += output.references.size();
    }
    if (std::max(nodes, references) >= options.most_numbers) return too_large(frame);
    KdTreeData tree;
    tree.frame = frame;
    tree.nodes = std::move(top.nodes);
    tree.references = std::move(top.references);
    tree.nodes.reserve(nodes);
    tree.references.reserve(references);
    for (std::size_t i = 0; i < parts.size(); ++i) join(tree, parts[i].node, std::move(outputs[i]));
    return tree;
}

} // namespace raywise
