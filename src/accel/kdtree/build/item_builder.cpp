#include "accel/kdtree/build/item_builder.h"

#include "accel/kdtree/build/binned_plane.h"
#include "accel/kdtree/build/plain_plane.h"

#include <algorithm>
#include <utility>

namespace raywise {

KdItemBuilder::KdItemBuilder(const KdContext& context, PageVector<BuildItem> items)
    : context_(context), event_builder_(context, output_), items_(std::move(items)) {}

KdOutput KdItemBuilder::build(const KdTask& root) {
    output_.nodes.resize(1);
    build(root, 0, 0);
    return std::move(output_);
}

KdOutput KdItemBuilder::build_top(const KdTask& root, std::uint32_t part_size, PageVector<KdPart>& parts) {
    parts_ = &parts;
    part_size_ = part_size;
    return build(root);
}

double KdItemBuilder::build(const KdTask& task, std::uint32_t node, std::size_t begin) {
    const KdCosts& costs = context_.costs;
    if (parts_ != nullptr && task.count <= part_size_) {
        put_aside(task, node, begin);
        return 0.0;
    }
    const bool by_costs = context_.options.split == KdSplit::surface_area;
    if (by_costs && task.count <= context_.options.most_exact)
        return event_builder_.build(items_.data() + begin, task, node);
    context_.report(task.count);
    if (context_.is_leaf(task.count, task.level)) return make_leaf(node, begin);
    const KdPlane plane = find_plane(task, begin);
    const double area = task.cell.half_area();
    if (!plane.found() || !(area > 0.0)) return make_leaf(node, begin);
    const double leaf_cost = costs.leaf(task.count);
    const bool is_bad = by_costs && !(costs.step + costs.test * plane.tests / area < leaf_cost);
    if (is_bad && parts_ != nullptr) { // whether it pays in the end is seen once all below it is built
        put_aside(task, node, begin);
        return 0.0;
    }
    if (is_bad && task.bad_splits >= context_.options.most_bad_splits) return make_leaf(node, begin);
    return split(task, plane, is_bad, node, begin);
}

double KdItemBuilder::split(const KdTask& task, const KdPlane& plane, bool is_bad, std::uint32_t node,
                            std::size_t begin) {
    const KdCosts& costs = context_.costs;
    // A split on credit has to pay in the end; then the node still has to know its primitives. Where there may be too many references, too.
    PageVector<std::uint32_t> own;
    const bool may_go_back = is_bad || 2 * std::uint64_t{task.count} > task.allowance;
    if (may_go_back) own = primitives_from(begin);
    KdSides sides(task, plane, task.bad_splits + (is_bad ? 1 : 0));
    partition(task, plane, begin, sides);
    if (!sides.share_allowance(task)) {
        output_.set_leaf(node, own);
        return costs.leaf(task.count);
    }

    const KdOutput::Mark before = output_.mark();
    const std::uint32_t child = output_.split(node, plane.axis, plane.position);
    const double above = build(sides.above, child + 1, begin + sides.below.count);
    items_.resize(begin + sides.below.count);
    const double below = build(sides.below, child, begin);
    const double cost = costs.step + (sides.below.cell.half_area() * below + sides.above.cell.half_area() * above) /
                                         task.cell.half_area();
    if (!is_bad || cost < costs.leaf(task.count)) return cost;
    output_.go_back(before);
    output_.set_leaf(node, own);
    return costs.leaf(task.count);
}

KdPlane KdItemBuilder::find_plane(const KdTask& task, std::size_t begin) {
    BuildItem* const items = items_.data() + begin;
    if (context_.options.split == KdSplit::surface_area) return find_binned_plane(items, task, context_.costs);
    if (task.count <= context_.options.leaf_size) return {};
    return find_plain_plane(items, task, context_.options.split);
}

void KdItemBuilder::partition(const KdTask& task, const KdPlane& plane, std::size_t begin, KdSides& sides) {
    if (plane.flat_below) return partition_along<true>(task, plane, begin, sides);
    partition_along<false>(task, plane, begin, sides);
}

// The lower side's items stay where they are, the upper side's follow them.
template <bool flat_below>
void KdItemBuilder::partition_along(const KdTask& task, const KdPlane& plane, std::size_t begin, KdSides& sides) {
    above_.resize(task.count + 1);
    BuildItem* below = items_.data() + begin;
    BuildItem* above = above_.data();
    const float position = plane.position;
    for (const BuildItem *next = below, *const end = below + task.count; next != end; ++next) {
        const BuildItem item = *next;
        const float lower = item.lower[plane.axis];
        const float upper = item.upper[plane.axis];
        // Without a jump that depends on the side: every item is written to both, and one of the two moves on.
        bool is_below = lower < position;
        bool is_above = upper > position;
        if (flat_below) {
            is_below |= upper <= position;
        } else {
            is_above |= lower >= position;
        }
        *below = item;
        *above = item;
        if (is_below && is_above) {
            const SideBoxes parts =
                context_.clipper.clip(item.id, task.cell, plane.axis, static_cast<double>(position));
            is_below = !parts.below.empty();
            is_above = !parts.above.empty();
            if (is_below) *below = rounded_bounds(parts.below).item(item.id, 1);
            if (is_above) *above = rounded_bounds(parts.above).item(item.id, 1);
        }
        below += is_below ? 1 : 0;
        above += is_above ? 1 : 0;
    }
    sides.below.count = static_cast<std::uint32_t>(below - (items_.data() + begin));
    sides.above.count = static_cast<std::uint32_t>(above - above_.data());
    items_.resize(begin + sides.below.count);
    items_.insert(items_.end(), above_.data(), above);
}

void KdItemBuilder::put_aside(const KdTask& task, std::uint32_t node, std::size_t begin) {
    parts_->push_back({task, {items_.begin() + static_cast<std::ptrdiff_t>(begin), items_.end()}, node});
}

double KdItemBuilder::make_leaf(std::uint32_t node, std::size_t begin) {
    output_.set_leaf(node, primitives_from(begin));
    return context_.costs.leaf(static_cast<std::uint32_t>(items_.size() - begin));
}

PageVector<std::uint32_t> KdItemBuilder::primitives_from(std::size_t begin) const {
    PageVector<std::uint32_t> list(items_.size() - begin);
    for (std::size_t i = begin; i < items_.size(); ++i) list[i - begin] = items_[i].id;
    return list;
}

} // namespace raywise
