#include "accel/bvh/build/spatial_splits.h"

#include "accel/bvh/build/kernels.h"
#include "accel/bvh/build/parts.h"
#include "accel/bvh/build/reference_cut.h"
#include "base/page_array.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace raywise {
namespace {

// A plane is tried where the overlap of the best sides without cutting is larger than that part of the root: the paper's
// alpha, which is 1e-5 there. Of 1e-5, 1e-3 and 1e-2 the trees cost the same within 0.3 %, and the build less and less; see
// docs/decisions/0011-bvh-builders.md.
constexpr double least_overlap = 1e-3;

constexpr int spatial_bins = 8; // of 8 and 16 the trees cost the same within 0.3 %, the build three quarters

// Nodes of so few references, or that part of all, are built by one thread to their leaves.
constexpr std::uint32_t least_job_size = 1024;
constexpr std::uint32_t jobs_wanted = 64;

// Zero where they do not meet.
double overlap_area(const Bounds& a, const Bounds& b) {
    const Bounds both{max_lanes(a.lower, b.lower), min_lanes(a.upper, b.upper)};
    for (int axis = 0; axis < 3; ++axis) {
        if (both.lower[axis] > both.upper[axis]) return 0.0;
    }
    return both.half_area();
}

// A node to be built: its items, and how many more there may be below it. They have room for as many behind them.
struct SplitTask {
    std::size_t begin;
    std::uint32_t count;
    std::uint32_t budget;
    int depth;
    Bounds bounds;
};

struct SpatialSplit {
    double weight = std::numeric_limits<double>::infinity(); // half areas times blocks
    int axis = no_axis;
    float position = 0.0f;
};

class TaskSplitter {
public:
    // items, scratch: room for those of the root and its budget.
    TaskSplitter(const BuildInput& input, const TreeCosts& costs, const Vec3& center, double root_area,
                 BuildItem* items, BuildItem* scratch)
        : input_(input),
          costs_(costs),
          center_(center),
          least_overlap_(least_overlap * root_area),
          items_(items),
          scratch_(scratch) {}

    const BuildItem* items(const SplitTask& task) const { return items_ + task.begin; }

    // Splits a task in two, which share its room, unless it is better off as a leaf.
    bool split(const SplitTask& task, std::array<SplitTask, 2>& halves) const {
        const std::uint32_t count = task.count;
        if (count == 1) return false;
        const bool may_be_leaf = count <= costs_.max_leaf_size;
        if (may_be_leaf && costs_.blocks(count) == 1) return false;

        BuildItem* const items = items_ + task.begin;
        Part part{0, count, 0, count, task.depth, task.bounds, Bounds::none()};
        for (std::uint32_t i = 0; i < count; ++i) part.centroids.extend(Bounds::of_centroid(items[i]));
        const PartSplitter splitter(items, scratch_ + task.begin, costs_, bvh_max_depth);
        if (splitter.must_halve(part)) {
            if (may_be_leaf) return false;
            take(task, splitter.halve(part), halves);
            return true;
        }
        const Binning binning(part.centroids, Bins::most);
        Bins bins(Bins::most);
        fill_bins(items, count, binning, bins);
        const BinSplit object = best_split(bins, task.bounds, costs_);

        const double area = task.bounds.half_area();
        double weight = std::numeric_limits<double>::infinity();
        if (object.axis != no_axis) {
            const auto unit = static_cast<double>(task.bounds.reciprocal_size());
            weight = static_cast<double>(object.weight) / (unit * unit);
        }
        SpatialSplit spatial;
        if (task.budget > 0 && count > 2 * costs_.block_size &&
            (object.axis == no_axis || overlap_area(object.left, object.right) > least_overlap_)) {
            spatial = find_spatial_split(task);
        }
        const double best = std::min(weight, spatial.weight);
        if (may_be_leaf && !(costs_.node * area + costs_.block * best < costs_.leaf(count) * area)) return false;
        if (spatial.weight < weight && cut(task, spatial, halves)) return true;
        take(task, object.axis == no_axis ? splitter.halve(part) : splitter.divide(part, object, binning), halves);
        return true;
    }

private:
    CuttableTriangle triangle(const BuildItem& item) const {
        Corners corners = input_.primitives.corners(item.id);
        for (Vec3& corner : corners) corner -= center_;
        return CuttableTriangle(corners);
    }

    // Bins of equal width along an axis, and the planes between them.
    struct SpatialBins {
        bool divides = false; // false where the axis is too short
        double lower = 0.0;
        double scale = 0.0;
        std::array<float, spatial_bins + 1> planes;
        std::array<Bounds, spatial_bins> bounds;
        std::array<std::uint32_t, spatial_bins> entries{};
        std::array<std::uint32_t, spatial_bins> exits{};

        SpatialBins(const Bounds& all, int axis) {
            const auto upper = static_cast<double>(all.upper[axis]);
            lower = static_cast<double>(all.lower[axis]);
            for (int bin = 0; bin <= spatial_bins; ++bin) {
                planes[static_cast<std::size_t>(bin)] =
                    static_cast<float>(lower + (upper - lower) * bin / spatial_bins);
            }
            bounds.fill(Bounds::none());
            for (std::size_t bin = 0; bin < spatial_bins; ++bin) {
                if (!(planes[bin] < planes[bin + 1])) return;
            }
            divides = true;
            scale = spatial_bins / (upper - lower);
        }
        int bin_of(float x) const {
            return std::clamp(static_cast<int>((static_cast<double>(x) - lower) * scale), 0, spatial_bins - 1);
        }
        void find_best(const TreeCosts& costs, int axis, SpatialSplit& best) const {
            std::array<double, spatial_bins> right;
            Bounds sum = Bounds::none();
            std::uint32_t primitives = 0;
            for (std::size_t bin = spatial_bins - 1; bin > 0; --bin) {
                sum.extend(bounds[bin]);
                primitives += exits[bin];
                right[bin] = primitives == 0 ? std::numeric_limits<double>::infinity()
                                             : sum.half_area() * costs.blocks(primitives);
            }
            sum = Bounds::none();
            primitives = 0;
            for (std::size_t bin = 1; bin < spatial_bins; ++bin) {
                sum.extend(bounds[bin - 1]);
                primitives += entries[bin - 1];
                if (primitives == 0) continue;
                const double weight = sum.half_area() * costs.blocks(primitives) + right[bin];
                if (weight < best.weight) best = {weight, axis, planes[bin]};
            }
        }
    };

    // Only across the longest axis: with the other two as well trees cost the same within 0.1 %, and building them takes twice as
    // long. A reference is cut at every plane between two bins that it lies across.
    SpatialSplit find_spatial_split(const SplitTask& task) const {
        const int axis = longest_axis(task.bounds);
        SpatialSplit best;
        SpatialBins bins(task.bounds, axis);
        if (!bins.divides) return best;
        for (std::uint32_t i = 0; i < task.count; ++i) {
            const BuildItem& item = items_[task.begin + i];
            const auto first = static_cast<std::size_t>(bins.bin_of(item.lower[axis]));
            const auto last = static_cast<std::size_t>(bins.bin_of(item.upper[axis]));
            ++bins.entries[first];
            ++bins.exits[last];
            Bounds rest = Bounds::of(item);
            if (first != last) {
                const CuttableTriangle cuttable = triangle(item);
                for (std::size_t bin = first; bin < last; ++bin) {
                    const CuttableTriangle::Sides sides = cuttable.cut(rest, axis, bins.planes[bin + 1]);
                    bins.bounds[bin].extend(sides.below);
                    rest = sides.above;
                }
            }
            bins.bounds[last].extend(rest);
        }
        bins.find_best(costs_, axis, best);
        return best;
    }

    enum class Side : unsigned char {
        below,
        above,
        both
    };

    CuttableTriangle::Sides parts_of(const BuildItem& item, const SpatialSplit& split) const {
        return triangle(item).cut(Bounds::of(item), split.axis, split.position);
    }

    // Where each item goes: below the plane, above it, or in parts to both. What is on both sides of the plane may be whole
    // on one where that costs less (the paper's reference unsplitting).
    PageVector<Side> sides_of(const SplitTask& task, const SpatialSplit& split) const {
        const BuildItem* const items = items_ + task.begin;
        PageVector<Side> sides(task.count);
        Bounds bounds[2] = {Bounds::none(), Bounds::none()};
        double counts[2] = {0.0, 0.0};
        for (std::uint32_t i = 0; i < task.count; ++i) {
            const BuildItem& item = items[i];
            if (item.upper[split.axis] <= split.position) {
                sides[i] = Side::below;
            } else if (item.lower[split.axis] >= split.position) {
                sides[i] = Side::above;
            } else {
                sides[i] = Side::both;
                const CuttableTriangle::Sides parts = parts_of(item, split);
                bounds[0].extend(parts.below);
                bounds[1].extend(parts.above);
                counts[0] += 1.0;
                counts[1] += 1.0;
                continue;
            }
            const int side = sides[i] == Side::below ? 0 : 1;
            bounds[side].extend(Bounds::of(item));
            counts[side] += 1.0;
        }
        std::uint32_t added = 0;
        for (std::uint32_t i = 0; i < task.count; ++i) {
            if (sides[i] != Side::both) continue;
            Bounds wider[2] = {bounds[0], bounds[1]};
            for (Bounds& side : wider) side.extend(Bounds::of(items[i]));
            const double areas[2] = {bounds[0].half_area(), bounds[1].half_area()};
            const double both = areas[0] * counts[0] + areas[1] * counts[1];
            const double below = wider[0].half_area() * counts[0] + areas[1] * (counts[1] - 1.0);
            const double above = areas[0] * (counts[0] - 1.0) + wider[1].half_area() * counts[1];
            if (both < below && both < above && added < task.budget) {
                ++added;
                continue;
            }
            sides[i] = below <= above ? Side::below : Side::above;
            const int side = below <= above ? 0 : 1;
            bounds[side] = wider[side];
            counts[1 - side] -= 1.0;
        }
        return sides;
    }

    // Fails when a side would be left without any items.
    bool cut(const SplitTask& task, const SpatialSplit& split, std::array<SplitTask, 2>& halves) const {
        const PageVector<Side> sides = sides_of(task, split);
        const auto count = [&](Side side) {
            return static_cast<std::uint32_t>(std::count(sides.begin(), sides.end(), side));
        };
        const std::uint32_t added = count(Side::both);
        halves[0].count = count(Side::below) + added;
        halves[1].count = count(Side::above) + added;
        if (halves[0].count == 0 || halves[1].count == 0) return false;
        // A side as large as the whole gains nothing and could go on for ever.
        if (halves[0].count >= task.count && halves[1].count >= task.count) return false;
        share(task, task.budget - added, halves);

        for (SplitTask& half : halves) half.bounds = Bounds::none();
        BuildItem* below = items_ + task.begin; // what has been read makes room
        BuildItem* above = scratch_ + task.begin;
        const auto put = [&](int side, const BuildItem& item) {
            *(side == 0 ? below : above)++ = item;
            halves[static_cast<std::size_t>(side)].bounds.extend(Bounds::of(item));
        };
        for (std::uint32_t i = 0; i < task.count; ++i) {
            const BuildItem item = items_[task.begin + i];
            if (sides[i] == Side::both) {
                const CuttableTriangle::Sides parts = parts_of(item, split); // again: kept, they would take much memory
                put(0, parts.below.item(item.id, 1));
                put(1, parts.above.item(item.id, 1));
            } else {
                put(sides[i] == Side::below ? 0 : 1, item);
            }
        }
        std::copy(scratch_ + task.begin, above, items_ + halves[1].begin);
        return true;
    }

    // The two sides lie one behind the other.
    void take(const SplitTask& task, const Halves& parts, std::array<SplitTask, 2>& halves) const {
        halves[0].count = parts.first.count();
        halves[0].bounds = parts.first.bounds;
        halves[1].count = parts.second.count();
        halves[1].bounds = parts.second.bounds;
        share(task, task.budget, halves);
        BuildItem* const second = items_ + task.begin + parts.second.begin;
        std::copy_backward(second, second + halves[1].count, items_ + halves[1].begin + halves[1].count);
    }

    // Shares budget and room in proportion to the items.
    static void share(const SplitTask& task, std::uint32_t budget, std::array<SplitTask, 2>& halves) {
        const std::uint64_t all = std::uint64_t{halves[0].count} + halves[1].count;
        halves[0].budget = static_cast<std::uint32_t>(std::uint64_t{budget} * halves[0].count / all);
        halves[1].budget = budget - halves[0].budget;
        halves[0].begin = task.begin;
        halves[1].begin = task.begin + halves[0].count + halves[0].budget;
        for (SplitTask& half : halves) half.depth = task.depth + 1;
    }

    const BuildInput& input_;
    const TreeCosts& costs_;
    const Vec3 center_;
    const double least_overlap_;
    BuildItem* const items_;
    BuildItem* const scratch_;
};

// A part of the tree that is built by one thread; its pairs and references are numbered from 0 until all are put together.
struct Job {
    SplitTask task;
    std::uint32_t pair; // where its root goes: a child of a top pair
    int child;
    PageVector<BvhPair> pairs;
    PageVector<std::uint32_t> references;
};

BvhNode build_subtree(const SplitTask& task, const TaskSplitter& splitter, Job& job) {
    std::array<SplitTask, 2> halves;
    if (!splitter.split(task, halves)) {
        const auto first = static_cast<std::uint32_t>(job.references.size());
        const BuildItem* const items = splitter.items(task);
        for (std::uint32_t i = 0; i < task.count; ++i) job.references.push_back(items[i].id);
        return make_node(task.bounds, first, task.count);
    }
    const auto pair = static_cast<std::uint32_t>(job.pairs.size());
    job.pairs.emplace_back();
    for (std::size_t child = 0; child < 2; ++child) {
        const BvhNode node = build_subtree(halves[child], splitter, job);
        job.pairs[pair].child[child] = node;
    }
    return make_node(task.bounds, pair, 0);
}

class SplitBuilder {
public:
    SplitBuilder(const BuildInput& input, const TaskSplitter& splitter,
                 const std::function<void(std::uint64_t)>& report, BvhTree& tree)
        : input_(input), splitter_(splitter), report_(report), tree_(tree) {}

    void build(const SplitTask& root) {
        job_size_ = std::max(least_job_size, root.count / jobs_wanted);
        std::vector<Job> open;
        open.push_back({root, 0, no_axis, {}, {}});
        while (!open.empty()) open = split_level(std::move(open));
        build_jobs();
        assemble();
    }

private:
    // Splits all open nodes, in parallel. Small ones, and what is a leaf, become jobs. Returns the children.
    std::vector<Job> split_level(std::vector<Job> open) {
        std::vector<std::array<SplitTask, 2>> halves(open.size());
        std::vector<char> is_split(open.size(), 0);
        input_.parallel.for_each(open.size(), [&](std::uint64_t i) {
            report_(0);
            if (open[i].task.count > job_size_) is_split[i] = splitter_.split(open[i].task, halves[i]) ? 1 : 0;
        });
        std::vector<Job> next;
        for (std::size_t i = 0; i < open.size(); ++i) {
            if (is_split[i] == 0) {
                jobs_.push_back(std::move(open[i]));
                continue;
            }
            const auto pair = static_cast<std::uint32_t>(top_.size());
            top_.emplace_back();
            place(open[i], make_node(open[i].task.bounds, pair, 0));
            for (int child = 0; child < 2; ++child) {
                next.push_back({halves[i][static_cast<std::size_t>(child)], pair, child, {}, {}});
            }
        }
        return next;
    }

    void place(const Job& job, const BvhNode& node) { node_of(job) = node; }
    BvhNode& node_of(const Job& job) { return job.child == no_axis ? tree_.root : top_[job.pair].child[job.child]; }

    void build_jobs() {
        // The largest first, so that no thread is left with one at the end.
        std::vector<std::uint32_t> order(jobs_.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return jobs_[a].task.count > jobs_[b].task.count; });
        input_.parallel.for_each(jobs_.size(), [&](std::uint64_t i) {
            Job& job = jobs_[order[i]];
            place(job, build_subtree(job.task, splitter_, job));
            report_(std::uint64_t{2} * job.task.count);
        });
    }

    // One array: the top, then the jobs' pairs.
    void assemble() {
        std::vector<std::uint32_t> pairs;
        std::vector<std::uint32_t> references;
        std::uint64_t pair_count = top_.size();
        std::uint64_t reference_count = 0;
        for (const Job& job : jobs_) {
            pairs.push_back(static_cast<std::uint32_t>(pair_count));
            references.push_back(static_cast<std::uint32_t>(reference_count));
            pair_count += job.pairs.size();
            reference_count += job.references.size();
        }
        tree_.pairs.resize(pair_count);
        tree_.references.resize(reference_count);
        input_.parallel.for_each(jobs_.size(), [&](std::uint64_t i) {
            Job& job = jobs_[i];
            const auto move = [&](BvhNode& node) { node.first += node.is_leaf() ? references[i] : pairs[i]; };
            for (std::size_t p = 0; p < job.pairs.size(); ++p) {
                BvhPair& pair = tree_.pairs[pairs[i] + p] = job.pairs[p];
                for (BvhNode& node : pair.child) move(node);
            }
            move(node_of(job));
            std::copy(job.references.begin(), job.references.end(), tree_.references.begin() + references[i]);
            job.pairs = {};
            job.references = {};
        });
        std::copy(top_.begin(), top_.end(), tree_.pairs.begin());
    }

    const BuildInput& input_;
    const TaskSplitter& splitter_;
    const std::function<void(std::uint64_t)>& report_;
    BvhTree& tree_;
    std::uint32_t job_size_ = 0;
    PageVector<BvhPair> top_;
    std::vector<Job> jobs_;
};

} // namespace

void build_with_spatial_splits(BuildReferences references, double budget, const BuildInput& input,
                               const TreeCosts& costs, const std::function<void(std::uint64_t)>& report,
                               BvhTree& tree) {
    references.keys = {};
    const std::uint32_t count = references.count;
    const double most_added =
        std::min(budget * count, static_cast<double>(std::numeric_limits<std::uint32_t>::max() - count));
    SplitTask root{0, count, static_cast<std::uint32_t>(most_added), 0, Bounds::none()};
    for (std::uint32_t i = 0; i < count; ++i) root.bounds.extend(Bounds::of(references.items[i]));
    const std::size_t room = std::size_t{count} + root.budget;
    PageArray<BuildItem> items;
    if (root.budget == 0) {
        items = std::move(references.items);
    } else {
        items = PageArray<BuildItem>(room);
        std::copy_n(references.items.data(), count, items.data());
        references.items = {};
    }
    PageArray<BuildItem> scratch(room);
    const TaskSplitter splitter(input, costs, tree.frame.center(), root.bounds.half_area(), items.data(),
                                scratch.data());
    SplitBuilder(input, splitter, report, tree).build(root);
}

} // namespace raywise
