#include "accel/kdtree/kd_tree_build.h"

#include "geometry/triangle_box_overlap.h"

#include <algorithm>
#include <array>
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

// Nodes and events have 30 bits for numbers.
constexpr std::uint64_t most_numbers = std::uint64_t{1} << 30;

// A step to a node outside the cache costs more than one within, and deeper trees outgrow the caches. With steps
// counted so many times, trees take half the memory and an eighth to a fifth less build time, and random chords take
// as long on the bunny (69,451 triangles) and a tenth longer in a soup of 200,000 small triangles. At the default
// costs a step counts like a test.
constexpr double step_weight = 4.0;

// How much cheaper a split counts that cuts off empty space.
constexpr double empty_bonus = 0.2;
// Splits on one path that may make things worse, in the hope of a good one after them (the lecture's "stretch over
// multiple levels"), are fewer than this. One saves 1 to 4 % of the tests of random chords on the bunny, a second
// next to nothing, and each costs about a tenth of the build.
constexpr int most_bad_splits = 2;
// Splits may repeat references up to so many per primitive in the whole tree.
constexpr std::uint64_t most_references_per_primitive = 8;
// Nodes of at most so many primitives, or of a certain part of all, are built apart from each other, by any number of
// threads.
constexpr std::uint64_t least_apart = 4096;
constexpr std::uint64_t parts_wanted = 64;

// ---- planes ----

// Where a box begins and ends on the scale that planes can lie on, rounded outwards.
float plane_below(double base, double x) {
    float f = round_down(x - base);
    while (KdTreeData::plane(base, f) > x) f = std::nextafter(f, -std::numeric_limits<float>::infinity());
    return f;
}
float plane_above(double base, double x) {
    float f = round_up(x - base);
    while (KdTreeData::plane(base, f) < x) f = std::nextafter(f, std::numeric_limits<float>::infinity());
    return f;
}

// ---- events ----

// Where a primitive's box ends, lies flat or begins along an axis. One number, so that sorting and merging compare
// nothing else: 32 bits of position, 2 of kind, 30 of the primitive's number within the part being built.
using Event = std::uint64_t;
enum Kind : std::uint64_t {
    ends = 0,
    lies = 1,
    begins = 2
}; // in the order of a sweep

// Unsigned numbers in the order of the floats.
std::uint32_t ordered_bits(float f) {
    f += 0.0f; // no negative zero
    std::uint32_t bits;
    std::memcpy(&bits, &f, sizeof bits);
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}
float from_ordered_bits(std::uint32_t ordered) {
    const std::uint32_t bits = (ordered & 0x80000000u) != 0 ? ordered & 0x7FFFFFFFu : ~ordered;
    float f;
    std::memcpy(&f, &bits, sizeof f);
    return f;
}
Event make_event(float position, Kind kind, std::uint32_t number) {
    return std::uint64_t{ordered_bits(position)} << 32 | kind << 30 | number;
}
std::uint32_t position_of(Event event) { return static_cast<std::uint32_t>(event >> 32); }
std::uint64_t kind_of(Event event) { return event >> 30 & 3u; }
std::uint32_t number_of(Event event) { return static_cast<std::uint32_t>(event) & 0x3FFFFFFFu; }

using EventLists = std::array<std::vector<Event>, 3>;

void add_events(EventLists& lists, const Vec3& base, const Box& box, std::uint32_t number) {
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<Event>& list = lists[static_cast<std::size_t>(axis)];
        const float lower = plane_below(base[axis], box.lower[axis]);
        const float upper = plane_above(base[axis], box.upper[axis]);
        if (lower == upper) {
            list.push_back(make_event(lower, lies, number));
        } else {
            list.push_back(make_event(lower, begins, number));
            list.push_back(make_event(upper, ends, number));
        }
    }
}

// By position and kind, 34 bits; equal ones keep their order, which is that of the numbers.
void radix_sort(std::vector<Event>& events) {
    constexpr unsigned digit_bits[3] = {12, 11, 11};
    std::vector<Event> other(events.size());
    unsigned shift = 30;
    for (const unsigned bits : digit_bits) {
        std::vector<std::size_t> next(std::size_t{1} << bits, 0);
        const Event mask = (Event{1} << bits) - 1;
        for (const Event event : events) ++next[event >> shift & mask];
        std::size_t begin = 0;
        for (std::size_t& n : next) begin += std::exchange(n, begin);
        for (const Event event : events) other[next[event >> shift & mask]++] = event;
        events.swap(other);
        shift += bits;
    }
}

// ---- clipping ----

// The boxes of the part of a triangle that is in a box, on either side of a plane.
//
// Clipping and the results are widened by `slack`. Cutting widened by what the polygon may be off keeps it that near
// to the exact one: without, a cut might lose a long edge that lies nearly in the plane. A cut is off by at most
// 2^-50 of the corners' coordinates, seven cuts follow each other, and the slack is four times that.
SideBoxes clip(const Corners& corners, const Box& box, int axis, double plane) {
    const Box own = {glm::min(corners[0], glm::min(corners[1], corners[2])),
                     glm::max(corners[0], glm::max(corners[1], corners[2]))};
    const double slack = 0x1p-45 * std::max(max_component(glm::abs(own.lower)), max_component(glm::abs(own.upper)));
    ClippedTriangle inside(corners);
    for (int a = 0; a < 3; ++a) {
        if (own.lower[a] < box.lower[a] || own.upper[a] > box.upper[a]) {
            inside.clip(a, box.lower[a] - slack, box.upper[a] + slack);
        }
    }
    SideBoxes boxes = inside.boxes_of_sides(axis, plane + slack, plane - slack);
    const auto finish = [&](Box& part, Box within) {
        if (part.empty()) return;
        for (int a = 0; a < 3; ++a) {
            part.lower[a] = std::max({part.lower[a] - slack, own.lower[a], within.lower[a]});
            part.upper[a] = std::min({part.upper[a] + slack, own.upper[a], within.upper[a]});
        } // empty now if it only came near
    };
    Box within_below = box;
    Box within_above = box;
    within_below.upper[axis] = plane;
    within_above.lower[axis] = plane;
    finish(boxes.below, within_below);
    finish(boxes.above, within_above);
    return boxes;
}

// ---- building ----

// What every part knows.
struct Setting {
    const BuildInput& input;
    Vec3 base;
    int levels;
    double test_cost;
    double step_cost;
    // Primitives of all nodes so far, and what that may come to: how much is done, and when to say so.
    double expected_work;
    std::atomic<std::uint64_t>& work;

    void count_work(std::uint64_t primitives) const {
        constexpr std::uint64_t step = 1u << 16;
        const std::uint64_t before = work.fetch_add(primitives, std::memory_order_relaxed);
        if ((before + primitives) / step == before / step) return;
        input.progress.report(0.2 + 0.8 * std::min(1.0, static_cast<double>(before) / expected_work), "kd-tree: nodes");
    }
};

// A node to be built: its primitives are in the events of three ranges at the top of the builder's lists.
struct Task {
    Box box;
    std::uint32_t count;     // primitives
    std::uint64_t allowance; // references its leaves may have, at least count
    int level;               // 0: the root
    int bad_splits;
};

struct Split {
    double cost = std::numeric_limits<double>::infinity(); // half area * primitives, of both sides, less the bonus
    int axis = -1;
    std::uint32_t position = 0;
    bool flat_below = true; // which side primitives that lie in the plane go to
};

// A subtree left to be built later.
struct Part {
    Task task;
    EventLists events;
    std::vector<std::uint32_t> primitives; // of the numbers in the events
    std::uint32_t node;                    // its place in the tree above
};

class Builder {
public:
    // parts: where nodes of at most `part_size` primitives go; null to build everything.
    Builder(const Setting& setting, EventLists& events, const std::vector<std::uint32_t>& primitives,
            std::vector<Part>* parts, std::uint64_t part_size)
        : setting_(setting),
          events_(events),
          primitives_(primitives),
          parts_(parts),
          part_size_(part_size),
          sides_(primitives.size()) {}

    void build(const Task& task) {
        nodes_.emplace_back();
        build(task, 0, {0, 0, 0});
    }

    std::vector<KdNode>& nodes() { return nodes_; }
    std::vector<std::uint32_t>& references() { return references_; }

private:
    using Begin = std::array<std::size_t, 3>;
    enum Side : std::uint8_t {
        below,
        above,
        both
    };

    // The events of the task are those from `begin` to the ends of the lists, and are used up. Returns the expected
    // cost of a ray that meets the node.
    double build(const Task& task, std::uint32_t node, const Begin& begin) {
        if (parts_ != nullptr && task.count <= part_size_) {
            put_aside(task, node, begin);
            return 0.0;
        }
        setting_.count_work(task.count);
        const double leaf_cost = setting_.test_cost * task.count;
        // No split costs less than its own step, whatever follows.
        if (leaf_cost <= setting_.step_cost || task.count <= 1 || task.level >= setting_.levels) {
            return make_leaf(node, begin), leaf_cost;
        }

        const double area = task.box.half_area();
        const Split split = find_split(task, begin);
        if (split.axis < 0 || !(area > 0.0)) return make_leaf(node, begin), leaf_cost;
        const double cost = setting_.step_cost + setting_.test_cost * split.cost / area;
        const bool bad = cost >= leaf_cost;
        const int bad_splits = task.bad_splits + (bad ? 1 : 0);
        if (bad && (bad_splits >= most_bad_splits || (cost > 4.0 * leaf_cost && task.count < 16))) {
            return make_leaf(node, begin), leaf_cost;
        }

        // A split on credit has to pay in the end; then the node still has to know its primitives.
        const bool may_take_back = parts_ == nullptr && bad;
        std::vector<std::uint32_t> own;
        if (may_take_back) own = list_primitives(begin);
        const std::size_t nodes_before = nodes_.size();
        const std::size_t references_before = references_.size();

        const auto a = static_cast<std::size_t>(split.axis);
        const double plane = KdTreeData::plane(setting_.base[split.axis], from_ordered_bits(split.position));
        Task low = task;
        Task high = task;
        low.box.upper[split.axis] = plane;
        high.box.lower[split.axis] = plane;
        low.level = high.level = task.level + 1;
        low.bad_splits = high.bad_splits = bad_splits;

        classify(task, split, plane, begin[a], low, high);
        const std::uint64_t together = std::uint64_t{low.count} + high.count;
        // Events of straddling primitives are lost by now only if the split goes ahead.
        if (together > task.allowance) return make_leaf(node, begin), leaf_cost;
        const std::uint64_t spare = task.allowance - together;
        low.allowance =
            low.count +
            (together == 0 ? 0
                           : static_cast<std::uint64_t>(static_cast<double>(spare) * (static_cast<double>(low.count) /
                                                                                      static_cast<double>(together))));
        high.allowance = task.allowance - low.allowance;

        const Begin high_begin = distribute(begin);
        const auto child = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        nodes_.emplace_back();
        nodes_[node] = KdNode::inner(split.axis, from_ordered_bits(split.position), child);

        const double high_cost = build(high, child + 1, high_begin);
        for (std::size_t i = 0; i < 3; ++i) events_[i].resize(high_begin[i]);
        const double low_cost = build(low, child, begin);
        const double real_cost =
            setting_.step_cost + (low.box.half_area() * low_cost + high.box.half_area() * high_cost) / area;
        if (may_take_back && real_cost >= leaf_cost) {
            nodes_.resize(nodes_before);
            references_.resize(references_before);
            put_leaf(node, own);
            return leaf_cost;
        }
        return real_cost;
    }

    // Sweeps a plane along each axis (Wald and Havran, algorithm 5).
    Split find_split(const Task& task, const Begin& begin) {
        std::array<Split, 3> best;
        const auto sweep_axis = [&](std::uint64_t axis) {
            best[axis] = sweep(task, static_cast<int>(axis), begin[axis]);
        };
        if (parts_ != nullptr && task.count >= 1u << 14) {
            setting_.input.parallel.for_each(3, sweep_axis);
        } else {
            for (std::uint64_t axis = 0; axis < 3; ++axis) sweep_axis(axis);
        }
        Split result = best[0];
        for (const Split& split : best) {
            if (split.cost < result.cost) result = split;
        }
        return result;
    }

    Split sweep(const Task& task, int axis, std::size_t begin) const {
        Split best;
        const std::vector<Event>& events = events_[static_cast<std::size_t>(axis)];
        const double lower = task.box.lower[axis];
        const double upper = task.box.upper[axis];
        if (!(lower < upper)) return best;
        const Vec3 size = task.box.size();
        const double across = size[(axis + 1) % 3] * size[(axis + 2) % 3];
        const double around = size[(axis + 1) % 3] + size[(axis + 2) % 3];
        const double base = setting_.base[axis];

        double low = 0.0; // primitives, as floating point numbers: they are factors only
        double high = task.count;
        const auto consider = [&](double plane, std::uint32_t position, double n_low, double n_high, bool flat_below,
                                  double factor) {
            const double cost =
                factor * ((n_low + n_high) * across + around * (n_low * (plane - lower) + n_high * (upper - plane)));
            if (cost < best.cost && plane > lower && plane < upper) best = {cost, axis, position, flat_below};
        };
        const auto factor_of = [](double n_low, double n_high) {
            return n_low == 0.0 || n_high == 0.0 ? 1.0 - empty_bonus : 1.0;
        };
        // Each event is a plane to consider, with no look at the next: among events at one place the last that ends
        // and the first that begins count the fewest primitives, which is what the place costs; the others only count
        // more. One side can be empty only at the first and at the last event, and where primitives lie flat.
        const Event* const first = events.data() + begin;
        const Event* const last = events.data() + events.size() - 1;
        for (const Event* event = first; event <= last; ++event) {
            const std::uint32_t position = position_of(*event);
            const double plane = KdTreeData::plane(base, from_ordered_bits(position));
            if (kind_of(*event) == lies) {
                // All that lie here go to the same side.
                const std::uint64_t here = *event >> 30;
                double lying = 1.0;
                while (event < last && event[1] >> 30 == here) {
                    ++event;
                    lying += 1.0;
                }
                high -= lying;
                consider(plane, position, low + lying, high, true, factor_of(low + lying, high));
                consider(plane, position, low, high + lying, false, factor_of(low, high + lying));
                low += lying;
                continue;
            }
            const double beginning = kind_of(*event) == begins ? 1.0 : 0.0;
            high -= 1.0 - beginning;
            if (event == first || event == last) {
                consider(plane, position, low, high, true, factor_of(low, high));
            } else {
                consider(plane, position, low, high, true, 1.0);
            }
            low += beginning;
        }
        return best;
    }

    // Which side each primitive of the task is on, from the events along the split axis; and new events for those on
    // both, clipped.
    void classify(const Task& task, const Split& split, double plane, std::size_t begin, Task& low, Task& high) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            new_low_[axis].clear();
            new_high_[axis].clear();
        }
        const std::vector<Event>& events = events_[static_cast<std::size_t>(split.axis)];
        low.count = 0;
        high.count = 0;
        for (std::size_t i = begin; i < events.size(); ++i) {
            const std::uint32_t position = position_of(events[i]);
            Side& side = sides_[number_of(events[i])];
            switch (kind_of(events[i])) {
                case begins:
                    side = position < split.position ? both : above;
                    break;
                case ends: // comes after the same primitive's beginning
                    if (position <= split.position) side = below;
                    break;
                default:
                    side =
                        position < split.position || (position == split.position && split.flat_below) ? below : above;
                    break;
            }
        }
        for (std::size_t i = begin; i < events.size(); ++i) {
            if (kind_of(events[i]) == ends) continue;
            const std::uint32_t number = number_of(events[i]);
            const Side side = sides_[number];
            low.count += side == below ? 1 : 0;
            high.count += side == above ? 1 : 0;
            if (side != both) continue;
            const SideBoxes boxes =
                clip(setting_.input.primitives.corners(primitives_[number]), task.box, split.axis, plane);
            if (!boxes.below.empty()) {
                add_events(new_low_, setting_.base, boxes.below, number);
                ++low.count;
            }
            if (!boxes.above.empty()) {
                add_events(new_high_, setting_.base, boxes.above, number);
                ++high.count;
            }
        }
    }

    // Keeps the lower side's events where they are and puts the upper side's behind them, sorted as they were; merges
    // the new ones.
    Begin distribute(const Begin& begin) {
        Begin high_begin;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::vector<Event>& events = events_[axis];
            const std::size_t end = events.size();
            scratch_.resize(end - begin[axis]);
            std::size_t low_end = begin[axis];
            std::size_t high_count = 0;
            for (std::size_t i = begin[axis]; i < end; ++i) {
                const Event event = events[i];
                const Side side = sides_[number_of(event)];
                events[low_end] = event;
                low_end += side == below ? 1 : 0;
                scratch_[high_count] = event;
                high_count += side == above ? 1 : 0;
            }
            std::sort(new_low_[axis].begin(), new_low_[axis].end());
            std::sort(new_high_[axis].begin(), new_high_[axis].end());
            const std::size_t low_count = low_end - begin[axis] + new_low_[axis].size();
            const std::size_t first_high = begin[axis] + low_count;
            events.resize(first_high + high_count + new_high_[axis].size());
            merge_from_behind(events.data() + begin[axis], low_end - begin[axis], new_low_[axis]);
            std::copy_n(scratch_.begin(), high_count, events.begin() + static_cast<std::ptrdiff_t>(first_high));
            merge_from_behind(events.data() + first_high, high_count, new_high_[axis]);
            high_begin[axis] = first_high;
        }
        return high_begin;
    }

    // Merges `count` sorted events with as many places behind them as `added` has events.
    static void merge_from_behind(Event* events, std::size_t count, const std::vector<Event>& added) {
        std::size_t rest = added.size();
        while (rest > 0) {
            if (count > 0 && events[count - 1] > added[rest - 1]) {
                events[count + rest - 1] = events[count - 1];
                --count;
            } else {
                events[count + rest - 1] = added[rest - 1];
                --rest;
            }
        }
    }

    std::vector<std::uint32_t> list_primitives(const Begin& begin) const {
        std::vector<std::uint32_t> list;
        for (std::size_t i = begin[0]; i < events_[0].size(); ++i) {
            if (kind_of(events_[0][i]) != ends) list.push_back(primitives_[number_of(events_[0][i])]);
        }
        return list;
    }

    void make_leaf(std::uint32_t node, const Begin& begin) { put_leaf(node, list_primitives(begin)); }

    void put_leaf(std::uint32_t node, std::vector<std::uint32_t> list) {
        if (list.size() == 1) {
            nodes_[node] = KdNode::leaf(list.front(), 1);
            return;
        }
        std::sort(list.begin(), list.end());
        nodes_[node] =
            KdNode::leaf(static_cast<std::uint32_t>(references_.size()), static_cast<std::uint32_t>(list.size()));
        references_.insert(references_.end(), list.begin(), list.end());
    }

    void put_aside(const Task& task, std::uint32_t node, const Begin& begin) {
        Part part;
        part.task = task;
        part.node = node;
        // Numbers of its own, so that no two parts share anything.
        std::vector<std::uint32_t> numbers;
        part.primitives.reserve(task.count);
        if (new_numbers_.size() < primitives_.size()) new_numbers_.resize(primitives_.size());
        for (std::size_t i = begin[0]; i < events_[0].size(); ++i) {
            if (kind_of(events_[0][i]) == ends) continue;
            const std::uint32_t number = number_of(events_[0][i]);
            numbers.push_back(number);
        }
        std::sort(numbers.begin(), numbers.end());
        for (const std::uint32_t number : numbers) {
            new_numbers_[number] = static_cast<std::uint32_t>(part.primitives.size());
            part.primitives.push_back(primitives_[number]);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            part.events[axis].reserve(events_[axis].size() - begin[axis]);
            for (std::size_t i = begin[axis]; i < events_[axis].size(); ++i) {
                const Event event = events_[axis][i];
                part.events[axis].push_back((event & ~Event{0x3FFFFFFFu}) | new_numbers_[number_of(event)]);
            }
        }
        parts_->push_back(std::move(part));
    }

    const Setting& setting_;
    EventLists& events_;
    const std::vector<std::uint32_t>& primitives_;
    std::vector<Part>* parts_;
    std::uint64_t part_size_;
    std::vector<Side> sides_;                // by number
    std::vector<std::uint32_t> new_numbers_; // by number
    std::vector<Event> scratch_;
    EventLists new_low_; // of clipped primitives
    EventLists new_high_;
    std::vector<KdNode> nodes_;
    std::vector<std::uint32_t> references_;
};

// Puts a finished part in its place: its root replaces the node that waits for it, the rest goes behind all.
void join(KdTreeData& tree, std::uint32_t place, std::vector<KdNode>& nodes,
          const std::vector<std::uint32_t>& references) {
    const auto moved = static_cast<std::uint32_t>(tree.nodes.size()) - 1; // the part's root is not moved with it
    const auto first = static_cast<std::uint32_t>(tree.references.size());
    for (KdNode& node : nodes) {
        if (!node.is_leaf()) {
            node.move_child(moved);
        } else if (node.count() != 1) {
            node.move_first(first);
        }
    }
    tree.nodes[place] = nodes.front();
    tree.nodes.insert(tree.nodes.end(), nodes.begin() + 1, nodes.end());
    tree.references.insert(tree.references.end(), references.begin(), references.end());
}

} // namespace

KdTreeData build_kd_tree(const BuildInput& input) {
    KdTreeData too_large;
    too_large.too_large = true;
    KdTreeData tree;
    const Primitives& all = input.primitives;
    const std::uint64_t hittable = all.hittable_count();
    if (hittable == 0) return tree;

    const Box& bounds = all.bounds();
    const Vec3 size = bounds.size();
    const Vec3 distance = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
    for (int axis = 0; axis < 3; ++axis) {
        // Within 16 sizes from zero a float has 20 bits left for places within the scene. float32 coordinates are
        // floats themselves in the one case, and in the other have differences that are.
        if (distance[axis] > 16.0 * size[axis]) tree.plane_base[axis] = bounds.lower[axis];
    }

    std::vector<std::uint32_t> primitives;
    primitives.reserve(hittable);
    for (std::uint32_t i = 0; i < all.count(); ++i) {
        if (all.is_hittable(i)) primitives.push_back(i);
    }
    if (hittable >= most_numbers) return too_large;

    EventLists events;
    for (auto& list : events) list.reserve(2 * hittable);
    for (std::uint32_t number = 0; number < hittable; ++number) {
        if (number % 0x10000u == 0) {
            input.progress.report(0.1 * static_cast<double>(number) / static_cast<double>(hittable), "kd-tree: boxes");
        }
        add_events(events, tree.plane_base, all.box(primitives[number]), number);
    }
    input.parallel.for_each(3, [&](std::uint64_t axis) { radix_sort(events[axis]); });
    input.progress.report(0.2, "kd-tree: nodes");

    std::atomic<std::uint64_t> work{0};
    const auto n = static_cast<double>(hittable);
    const Setting setting = {input,
                             tree.plane_base,
                             most_levels(hittable),
                             input.costs.primitive_test_ns,
                             step_weight * input.costs.node_step_ns,
                             2.0 * n * std::log2(n + 1.0),
                             work};
    const Task root = {bounds, static_cast<std::uint32_t>(hittable), hittable * most_references_per_primitive + 64, 0,
                       0};
    std::vector<Part> parts;
    {
        Builder top(setting, events, primitives, &parts, std::max(least_apart, hittable / parts_wanted));
        top.build(root);
        tree.nodes = std::move(top.nodes());
        tree.references = std::move(top.references());
    }
    events = {};

    std::vector<std::vector<KdNode>> nodes(parts.size());
    std::vector<std::vector<std::uint32_t>> references(parts.size());
    input.parallel.for_each(parts.size(), [&](std::uint64_t i) {
        Part part = std::move(parts[i]); // freed when done; its place stays behind
        Builder builder(setting, part.events, part.primitives, nullptr, 0);
        builder.build(part.task);
        nodes[i] = std::move(builder.nodes());
        references[i] = std::move(builder.references());
    });
    std::uint64_t all_nodes = tree.nodes.size();
    for (const auto& part : nodes) all_nodes += part.size();
    if (all_nodes >= most_numbers) return too_large;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        join(tree, parts[i].node, nodes[i], references[i]);
        nodes[i] = {};
        references[i] = {};
    }
    return tree;
}

} // namespace raywise
