#include "accel/kdtree/build/event_builder.h"

#include "accel/kdtree/build/sweep.h"

#include <algorithm>

namespace raywise {

double KdEventBuilder::build(const BuildItem* items, const KdTask& task, std::uint32_t node) {
    context_.report(task.count);
    if (context_.is_leaf(task.count, task.level)) {
        leaf_.clear();
        for (std::uint32_t i = 0; i < task.count; ++i) leaf_.push_back(items[i].id);
        output_.set_leaf(node, leaf_);
        return context_.costs.leaf(task.count);
    }
    for (auto& list : events_) list.clear();
    primitives_.clear();
    sides_.resize(task.count);
    for (std::uint32_t number = 0; number < task.count; ++number) {
        primitives_.push_back(items[number].id);
        add_events(events_, Bounds::of(items[number]), number);
    }
    for (auto& list : events_) sort_events(list, above_);
    return build(task, node, {0, 0, 0});
}

// The events of the task are those from `begin` to the ends of the lists, and are used up.
double KdEventBuilder::build(const KdTask& task, std::uint32_t node, const Begin& begin) {
    const KdCosts& costs = context_.costs;
    if (context_.is_leaf(task.count, task.level)) return make_leaf(node, begin);
    const KdPlane plane = find_plane(task, begin);
    const double area = task.cell.half_area();
    if (!plane.found() || !(area > 0.0)) return make_leaf(node, begin);
    const double leaf_cost = costs.leaf(task.count);
    const bool is_bad = !(costs.step + costs.test * plane.tests / area < leaf_cost);
    if (is_bad && task.bad_splits >= context_.options.most_bad_splits) return make_leaf(node, begin);
    return split(task, plane, is_bad, node, begin);
}

double KdEventBuilder::split(const KdTask& task, const KdPlane& plane, bool is_bad, std::uint32_t node,
                             const Begin& begin) {
    const KdCosts& costs = context_.costs;
    // A split on credit has to pay in the end; then the node still has to know its primitives.
    PageVector<std::uint32_t> own;
    if (is_bad) list_primitives(begin, own);
    KdSides sides(task, plane, task.bad_splits + (is_bad ? 1 : 0));
    classify(plane, begin);
    cut(task, plane, begin, sides);
    // Events of what is on both sides are lost only if the split goes ahead.
    if (!sides.share_allowance(task)) return make_leaf(node, begin);

    const Begin above_begin = distribute(begin);
    const KdOutput::Mark before = output_.mark();
    const std::uint32_t child = output_.split(node, plane.axis, plane.position);
    const double cost_above = build(sides.above, child + 1, above_begin);
    for (std::size_t axis = 0; axis < 3; ++axis) events_[axis].resize(above_begin[axis]);
    const double cost_below = build(sides.below, child, begin);
    const double cost =
        costs.step +
        (sides.below.cell.half_area() * cost_below + sides.above.cell.half_area() * cost_above) / task.cell.half_area();
    if (!is_bad || cost < costs.leaf(task.count)) return cost;
    output_.go_back(before);
    output_.set_leaf(node, own);
    return costs.leaf(task.count);
}

KdPlane KdEventBuilder::find_plane(const KdTask& task, const Begin& begin) const {
    KdPlane best;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        sweep_axis(events_[a].data() + begin[a], events_[a].size() - begin[a], axis, task, context_.costs, best);
    }
    return best;
}

// Which side each primitive of the task is on, from the events along the split axis.
void KdEventBuilder::classify(const KdPlane& plane, const Begin& begin) {
    const auto axis = static_cast<std::size_t>(plane.axis);
    const std::uint64_t ends_here = KdEvent(plane.position, KdEvent::ends, 0).key();
    const std::uint64_t lies_here = KdEvent(plane.position, KdEvent::lies, 0).key();
    const std::uint64_t begins_here = KdEvent(plane.position, KdEvent::begins, 0).key();
    for (std::size_t i = begin[axis]; i < events_[axis].size(); ++i) {
        const KdEvent event = events_[axis][i];
        Side& side = sides_[event.number()];
        switch (event.kind()) {
            case KdEvent::begins:
                side = event.key() < begins_here ? both : above;
                break;
            case KdEvent::ends: // comes after the same primitive's beginning
                if (event.key() <= ends_here) side = below;
                break;
            default:
                side = event.key() < lies_here || (event.key() == lies_here && plane.flat_below) ? below : above;
                break;
        }
    }
}

// Counts the sides, and makes new events for what is on both.
void KdEventBuilder::cut(const KdTask& task, const KdPlane& plane, const Begin& begin, KdSides& sides) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        new_below_[axis].clear();
        new_above_[axis].clear();
    }
    sides.below.count = 0;
    sides.above.count = 0;
    const auto axis = static_cast<std::size_t>(plane.axis);
    for (std::size_t i = begin[axis]; i < events_[axis].size(); ++i) {
        const KdEvent event = events_[axis][i];
        if (event.kind() == KdEvent::ends) continue;
        const std::uint32_t number = event.number();
        const Side side = sides_[number];
        sides.below.count += side == below ? 1 : 0;
        sides.above.count += side == above ? 1 : 0;
        if (side != both) continue;
        const SideBoxes parts =
            context_.clipper.clip(primitives_[number], task.cell, plane.axis, static_cast<double>(plane.position));
        if (!parts.below.empty()) {
            add_events(new_below_, rounded_bounds(parts.below), number);
            ++sides.below.count;
        }
        if (!parts.above.empty()) {
            add_events(new_above_, rounded_bounds(parts.above), number);
            ++sides.above.count;
        }
    }
}

namespace {

// Merges `count` sorted events with as many places behind them as `added` has events.
void merge_from_behind(KdEvent* events, std::size_t count, const PageVector<KdEvent>& added) {
    std::size_t rest = added.size();
    while (rest > 0) {
        if (count > 0 && added[rest - 1] < events[count - 1]) {
            events[count + rest - 1] = events[count - 1];
            --count;
        } else {
            events[count + rest - 1] = added[rest - 1];
            --rest;
        }
    }
}

} // namespace

// Keeps the lower side's events where they are and puts the upper side's behind them, sorted as they were; merges the new ones.
KdEventBuilder::Begin KdEventBuilder::distribute(const Begin& begin) {
    Begin above_begin;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        PageVector<KdEvent>& events = events_[axis];
        const std::size_t end = events.size();
        if (above_.size() < end - begin[axis] + 1) above_.resize(end - begin[axis] + 1);
        std::size_t below_end = begin[axis];
        std::size_t above_count = 0;
        for (std::size_t i = begin[axis]; i < end; ++i) {
            const KdEvent event = events[i];
            const Side side = sides_[event.number()];
            events[below_end] = event;
            below_end += side == below ? 1 : 0;
            above_[above_count] = event;
            above_count += side == above ? 1 : 0;
        }
        std::sort(new_below_[axis].begin(), new_below_[axis].end());
        std::sort(new_above_[axis].begin(), new_above_[axis].end());
        const std::size_t below_count = below_end - begin[axis] + new_below_[axis].size();
        const std::size_t first_above = begin[axis] + below_count;
        events.resize(first_above + above_count + new_above_[axis].size());
        merge_from_behind(events.data() + begin[axis], below_end - begin[axis], new_below_[axis]);
        std::copy_n(above_.begin(), above_count, events.begin() + static_cast<std::ptrdiff_t>(first_above));
        merge_from_behind(events.data() + first_above, above_count, new_above_[axis]);
        above_begin[axis] = first_above;
    }
    return above_begin;
}

double KdEventBuilder::make_leaf(std::uint32_t node, const Begin& begin) {
    list_primitives(begin, leaf_);
    output_.set_leaf(node, leaf_);
    return context_.costs.leaf(static_cast<std::uint32_t>(leaf_.size()));
}

void KdEventBuilder::list_primitives(const Begin& begin, PageVector<std::uint32_t>& list) const {
    list.clear();
    for (std::size_t i = begin[0]; i < events_[0].size(); ++i) {
        if (events_[0][i].kind() != KdEvent::ends) list.push_back(primitives_[events_[0][i].number()]);
    }
}

} // namespace raywise
