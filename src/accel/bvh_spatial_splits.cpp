#include "accel/bvh_spatial_splits.h"

#include "accel/bvh_build_kernels.h"
#include "accel/bvh_build_parts.h"
#include "accel/bvh_reference_cut.h"

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

Bounds bounds_of(const std::vector<BuildItem>& items) {
    Bounds bounds = Bounds::none();
    for (const BuildItem& item : items) bounds.extend(Bounds::of(item));
    return bounds;
}

// Zero where they do not meet.
double overlap_area(const Bounds& a, const Bounds& b) {
    const Bounds both{max_lanes(a.lower, b.lower), min_lanes(a.upper, b.upper)};
    for (int axis = 0; axis < 3; ++axis) {
        if (both.lower[axis] > both.upper[axis]) return 0.0;
    }
    return both.half_area();
}

// A node to be built: its references, and how many more there may be below it.
struct SplitTask {
    std::vector<BuildItem> items;
    Bounds bounds;
    int depth;
    std::uint32_t budget;

    std::uint32_t count() const { return static_cast<std::uint32_t>(items.size()); }
};

struct SpatialSplit {
    double weight = std::numeric_limits<double>::infinity(); // half areas times blocks
    int axis = no_axis;
    float position = 0.0f;
};

class TaskSplitter {
public:
    TaskSplitter(const BuildInput& input, const TreeCosts& costs, const Vec3& center, double root_area)
        : input_(input), costs_(costs), center_(center), least_overlap_(least_overlap * root_area) {}

    // Splits a task in two, whose items it gives up, unless it is better off as a leaf.
    bool split(SplitTask& task, std::array<SplitTask, 2>& halves) const {
        const std::uint32_t count = task.count();
        if (count == 1) return false;
        const bool may_be_leaf = count <= costs_.max_leaf_size;
        if (may_be_leaf && costs_.blocks(count) == 1) return false;

        Part part{0, count, 0, count, task.depth, task.bounds, Bounds::none()};
        for (const BuildItem& item : task.items) part.centroids.extend(Bounds::of_centroid(item));
        std::vector<BuildItem> scratch(count);
        const PartSplitter splitter(task.items.data(), scratch.data(), costs_, bvh_max_depth);
        if (splitter.must_halve(part)) {
            if (may_be_leaf) return false;
            take(task, splitter.halve(part), halves);
            return true;
        }
        const Binning binning(part.centroids, Bins::most);
        Bins bins(Bins::most);
        fill_bins(task.items.data(), count, binning, bins);
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
        for (const BuildItem& item : task.items) {
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

    // Puts the references on the two sides of the plane. Fails when that would add more references than there may be, or
    // leave a side without any.
    bool cut(SplitTask& task, const SpatialSplit& split, std::array<SplitTask, 2>& halves) const {
        const auto is_below = [&](const BuildItem& item) { return item.upper[split.axis] <= split.position; };
        const auto is_above = [&](const BuildItem& item) { return item.lower[split.axis] >= split.position; };
        const auto parts_of = [&](const BuildItem& item) {
            return triangle(item).cut(Bounds::of(item), split.axis, split.position);
        };
        Bounds bounds[2] = {Bounds::none(), Bounds::none()};
        std::size_t most[2] = {0, 0};
        for (const BuildItem& item : task.items) {
            const bool below = is_below(item);
            const bool above = !below && is_above(item);
            if (!above) ++most[0];
            if (!below) ++most[1];
            if (below || above) {
                bounds[above ? 1 : 0].extend(Bounds::of(item));
            } else {
                const CuttableTriangle::Sides parts = parts_of(item);
                bounds[0].extend(parts.below);
                bounds[1].extend(parts.above);
            }
        }
        std::vector<BuildItem> sides[2];
        for (int side = 0; side < 2; ++side) sides[side].reserve(most[side]);
        double counts[2] = {static_cast<double>(most[0]), static_cast<double>(most[1])};
        std::uint32_t added = 0;
        for (const BuildItem& item : task.items) {
            const bool below = is_below(item);
            if (below || is_above(item)) {
                sides[below ? 0 : 1].push_back(item);
                continue;
            }
            // It may be whole on the one side where that costs less (the paper's reference unsplitting).
            const Bounds whole = Bounds::of(item);
            Bounds wider[2] = {bounds[0], bounds[1]};
            for (Bounds& side : wider) side.extend(whole);
            const double areas[2] = {bounds[0].half_area(), bounds[1].half_area()};
            const double both = areas[0] * counts[0] + areas[1] * counts[1];
            const double left = wider[0].half_area() * counts[0] + areas[1] * (counts[1] - 1.0);
            const double right = areas[0] * (counts[0] - 1.0) + wider[1].half_area() * counts[1];
            if (both < left && both < right && added < task.budget) {
                const CuttableTriangle::Sides parts = parts_of(item); // again: kept, they would take most of the memory
                sides[0].push_back(parts.below.item(item.id, 1));
                sides[1].push_back(parts.above.item(item.id, 1));
                ++added;
                continue;
            }
            const int side = left <= right ? 0 : 1;
            sides[side].push_back(item);
            bounds[side] = wider[side];
            counts[1 - side] -= 1.0;
        }
        if (sides[0].empty() || sides[1].empty()) return false;
        // A side as large as the whole gains nothing and could go on for ever.
        if (sides[0].size() >= task.items.size() && sides[1].size() >= task.items.size()) return false;
        for (int side = 0; side < 2; ++side) {
            SplitTask& half = halves[static_cast<std::size_t>(side)];
            half.items = std::move(sides[side]);
            half.bounds = bounds_of(half.items);
        }
        share(task, task.budget - added, halves);
        return true;
    }

    static void take(SplitTask& task, const Halves& parts, std::array<SplitTask, 2>& halves) {
        halves[1].items.assign(task.items.begin() + parts.second.begin, task.items.end());
        halves[1].bounds = parts.second.bounds;
        task.items.resize(parts.first.end);
        halves[0].items = std::move(task.items);
        halves[0].bounds = parts.first.bounds;
        share(task, task.budget, halves);
    }

    static void share(SplitTask& task, std::uint32_t budget, std::array<SplitTask, 2>& halves) {
        const std::uint64_t all = std::uint64_t{halves[0].count()} + halves[1].count();
        halves[0].budget = static_cast<std::uint32_t>(std::uint64_t{budget} * halves[0].count() / all);
        halves[1].budget = budget - halves[0].budget;
        for (SplitTask& half : halves) half.depth = task.depth + 1;
        task.items = {};
    }

    const BuildInput& input_;
    const TreeCosts& costs_;
    const Vec3 center_;
    const double least_overlap_;
};

// A part of the tree that is built by one thread; its pairs and references are numbered from 0 until all are put together.
struct Job {
    SplitTask task;
    std::uint32_t pair; // where its root goes: a child of a top pair
    int child;
    std::vector<BvhPair> pairs;
    std::vector<std::uint32_t> references;
};

BvhNode build_subtree(SplitTask& task, const TaskSplitter& splitter, Job& job) {
    std::array<SplitTask, 2> halves;
    if (!splitter.split(task, halves)) {
        const auto first = static_cast<std::uint32_t>(job.references.size());
        for (const BuildItem& item : task.items) job.references.push_back(item.id);
        return make_node(task.bounds, first, task.count());
    }
    const auto pair = static_cast<std::uint32_t>(job.pairs.size());
    job.pairs.emplace_back();
    for (std::size_t child = 0; child < 2; ++child) {
        const BvhNode node = build_subtree(halves[child], splitter, job);
        halves[child].items = {};
        job.pairs[pair].child[child] = node;
    }
    return make_node(task.bounds, pair, 0);
}

class SplitBuilder {
public:
    SplitBuilder(const BuildInput& input, const TaskSplitter& splitter,
                 const std::function<void(std::uint64_t)>& report, BvhTree& tree)
        : input_(input), splitter_(splitter), report_(report), tree_(tree) {}

    void build(SplitTask root) {
        job_size_ = std::max(least_job_size, root.count() / jobs_wanted);
        std::vector<Job> open;
        open.push_back({std::move(root), 0, no_axis, {}, {}});
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
            if (open[i].task.count() > job_size_) is_split[i] = splitter_.split(open[i].task, halves[i]) ? 1 : 0;
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
                next.push_back({std::move(halves[i][static_cast<std::size_t>(child)]), pair, child, {}, {}});
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
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return jobs_[a].task.count() > jobs_[b].task.count();
        });
        input_.parallel.for_each(jobs_.size(), [&](std::uint64_t i) {
            Job& job = jobs_[order[i]];
            const std::uint32_t count = job.task.count();
            place(job, build_subtree(job.task, splitter_, job));
            job.task.items = {};
            report_(std::uint64_t{2} * count);
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
    std::vector<BvhPair> top_;
    std::vector<Job> jobs_;
};

} // namespace

void build_with_spatial_splits(BuildReferences references, double budget, const BuildInput& input,
                               const TreeCosts& costs, const std::function<void(std::uint64_t)>& report,
                               BvhTree& tree) {
    SplitTask root{{references.items.data(), references.items.data() + references.count},
                   references.bounds,
                   0,
                   static_cast<std::uint32_t>(budget * references.count)};
    references = {};
    root.bounds = bounds_of(root.items);
    const TaskSplitter splitter(input, costs, tree.center, root.bounds.half_area());
    SplitBuilder(input, splitter, report, tree).build(std::move(root));
}

} // namespace raywise
