#include "accel/bvh_build_top_down.h"

#include "accel/bvh_build_bins.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

namespace raywise {
namespace {

// Up to so many items a thread builds the whole subtree; above, all threads share the work on one node. It depends on
// nothing but the scene, and neither does the tree therefore.
constexpr std::uint32_t job_size = 1024;

// The clusters' own trees have to fit below.
constexpr int max_depth = bvh_max_depth - Clusters::most_rounds;

// A node to be built: items [begin, end), whose primitives are references from `first` on.
struct Part {
    std::uint32_t begin;
    std::uint32_t end;
    std::uint32_t first;
    std::uint32_t primitives;
    int depth;
    Bounds bounds;

    std::uint32_t count() const { return end - begin; }
};

int ceil_log2(std::uint32_t n) {
    int log = 0;
    while (log < 32 && (std::uint64_t{1} << log) < n) ++log;
    return log;
}

BvhNode make_node(const Bounds& bounds, std::uint32_t first, std::uint32_t count) {
    BvhNode node;
    for (int axis = 0; axis < 3; ++axis) {
        node.planes[0][axis] = bounds.lower[axis];
        node.planes[1][axis] = bounds.upper[axis];
    }
    node.first = first;
    node.count = count;
    return node;
}

int longest_axis(const Bounds& bounds) {
    const Lanes extents = bounds.upper - bounds.lower;
    const float extent[3] = {extents[0], extents[1], extents[2]};
    const int xy = extent[0] >= extent[1] ? 0 : 1;
    return extent[xy] >= extent[2] ? xy : 2;
}

class TopDownBuilder {
public:
    TopDownBuilder(Clusters& clusters, const TreeCosts& costs, const Parallel& parallel,
                   const std::function<void(std::uint64_t)>& report, BvhTree& tree)
        : clusters_(clusters),
          items_(clusters.items()),
          costs_(costs),
          parallel_(parallel),
          report_(report),
          tree_(tree) {}

    void build(const Bounds& bounds) {
        split_top(bounds);
        build_jobs();
        assemble();
    }

private:
    // The part of the tree that a thread builds alone. Its pairs are numbered from 0 until it is assembled.
    struct Job {
        Part part;
        std::uint32_t pair; // where its root goes: a child of a top pair
        int child;
        std::vector<BvhPair> pairs;
    };

    // ---- The top of the tree: one node after the other, each with all threads.

    void split_top(const Bounds& bounds) {
        struct Open {
            Part part;
            std::uint32_t pair;
            int child;
        };
        const auto count = static_cast<std::uint32_t>(items_.size());
        const auto primitives = static_cast<std::uint32_t>(tree_.references.size());
        std::vector<Open> open{{{0, count, 0, primitives, 0, bounds}, 0, no_axis}};
        while (!open.empty()) {
            const Open node = open.back();
            open.pop_back();
            if (node.part.count() <= job_size) {
                jobs_.push_back({node.part, node.pair, node.child, {}});
                continue;
            }
            const auto pair = static_cast<std::uint32_t>(top_.size());
            top_.emplace_back();
            place(node.pair, node.child, make_node(node.part.bounds, pair, 0));
            const auto [left, right] = split_shared(node.part);
            open.push_back({right, pair, 1});
            open.push_back({left, pair, 0});
        }
    }

    void place(std::uint32_t pair, int child, const BvhNode& node) {
        (child == no_axis ? tree_.root : top_[pair].child[child]) = node;
    }

    // Folds all items of a part. Pieces are folded on their own and then merged: minima, maxima and counts do not depend
    // on how the part was cut.
    template <class Result, class Add, class Merge>
    Result reduce(const Part& part, const Result& initial, const Add& add, const Merge& merge) {
        std::mutex mutex;
        Result result = initial;
        parallel_.for_blocks(part.count(), 4096, [&](std::uint64_t begin, std::uint64_t end) {
            Result piece = initial;
            for (std::uint64_t i = begin; i < end; ++i) add(piece, items_[part.begin + i]);
            const std::lock_guard lock(mutex);
            merge(result, piece);
        });
        return result;
    }

    std::pair<Part, Part> split_shared(const Part& part) {
        report_(0); // large scenes take a while; whoever wants to stop is heard
        const Bounds centroids = reduce(
            part, Bounds::none(), [](Bounds& b, const BuildItem& item) { b.extend(Bounds::of_centroid(item)); },
            [](Bounds& b, const Bounds& other) { b.extend(other); });
        if (must_halve(part)) return halve(part, centroids);
        const Binning binning(centroids, Bins::count_for(part.count()));
        const Bins bins = reduce(
            part, Bins(binning.count()), [&](Bins& b, const BuildItem& item) { b.add(item, binning); },
            [](Bins& b, const Bins& other) { b.add(other); });
        const BinSplit split = bins.best_split(costs_);
        return split.axis == no_axis ? halve(part, centroids) : divide(part, split, binning);
    }

    // ---- Subtrees.

    void build_jobs() {
        // The largest first, so that no thread is left with one at the end.
        std::vector<std::uint32_t> order(jobs_.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            const std::uint32_t size_a = jobs_[a].part.primitives;
            const std::uint32_t size_b = jobs_[b].part.primitives;
            return size_a > size_b || (size_a == size_b && a < b);
        });
        parallel_.for_each(jobs_.size(), [&](std::uint64_t i) {
            Job& job = jobs_[order[i]];
            job.pairs.reserve(job.part.primitives / std::max(2u, costs_.block_size));
            place(job.pair, job.child, build_node(job.part, job));
            report_(job.part.primitives);
        });
    }

    BvhNode build_node(const Part& part, Job& job) {
        if (part.count() == 1) {
            return clusters_.emit(items_[part.begin], job.pairs, tree_.references.data(), part.first);
        }
        std::pair<Part, Part> halves;
        if (!split(part, halves)) {
            std::uint32_t* references = tree_.references.data() + part.first;
            for (std::uint32_t i = part.begin; i < part.end; ++i) {
                references = clusters_.emit_primitives(items_[i], references);
            }
            return make_node(part.bounds, part.first, part.primitives);
        }
        const auto pair = static_cast<std::uint32_t>(job.pairs.size());
        job.pairs.emplace_back();
        const BvhNode left = build_node(halves.first, job);
        const BvhNode right = build_node(halves.second, job);
        job.pairs[pair].child[0] = left;
        job.pairs[pair].child[1] = right;
        return make_node(part.bounds, pair, 0);
    }

    // Splits a part unless it is better off as a leaf.
    bool split(const Part& part, std::pair<Part, Part>& halves) {
        const bool may_be_leaf = part.primitives <= costs_.max_leaf_size;
        if (may_be_leaf && costs_.blocks(part.primitives) == 1) return false;
        Bounds centroids = Bounds::none();
        for (std::uint32_t i = part.begin; i < part.end; ++i) centroids.extend(Bounds::of_centroid(items_[i]));
        if (must_halve(part)) {
            if (may_be_leaf) return false;
            halves = halve(part, centroids);
            return true;
        }
        const Binning binning(centroids, Bins::count_for(part.count()));
        Bins bins(binning.count());
        for (std::uint32_t i = part.begin; i < part.end; ++i) bins.add(items_[i], binning);
        const BinSplit split = bins.best_split(costs_);
        if (may_be_leaf && !worth_splitting(part, split)) return false;
        halves = split.axis == no_axis ? halve(part, centroids) : divide(part, split, binning);
        return true;
    }

    bool worth_splitting(const Part& part, const BinSplit& split) const {
        if (split.axis == no_axis) return false;
        const double area = part.bounds.half_area();
        return costs_.node * area + costs_.block * split.weight < costs_.leaf(part.primitives) * area;
    }

    // ---- Splits.

    // A split by the heuristic may leave nearly all items on one side. It is allowed as long as halving from there on
    // would still end in time: depth + ceil_log2(count) <= max_depth holds for the root (count < 2^32) and for the
    // children of every node, because halving lowers the logarithm by one where depth + 1 would exceed the bound. So a
    // node at max_depth has one item.
    static bool must_halve(const Part& part) { return part.depth + ceil_log2(part.count()) >= max_depth; }

    std::pair<Part, Part> divide(const Part& part, const BinSplit& split, const Binning& binning) {
        const auto begin = items_.begin() + part.begin;
        const auto middle = std::partition(begin, items_.begin() + part.end, [&](const BuildItem& item) {
            return binning.bin(item, split.axis) < split.bin;
        });
        return cut(part, static_cast<std::uint32_t>(middle - items_.begin()), split.left, split.right);
    }

    // In the middle of the sorted centroids; where they all coincide, of the numbers.
    std::pair<Part, Part> halve(const Part& part, const Bounds& centroids) {
        const int axis = longest_axis(centroids);
        const std::uint32_t middle = part.begin + part.count() / 2;
        std::nth_element(items_.begin() + part.begin, items_.begin() + middle, items_.begin() + part.end,
                         [axis](const BuildItem& a, const BuildItem& b) {
                             const float ca = a.centroid(axis);
                             const float cb = b.centroid(axis);
                             return ca < cb || (ca == cb && (a.id < b.id || (a.id == b.id && a.count < b.count)));
                         });
        Bounds left = Bounds::none();
        Bounds right = Bounds::none();
        for (std::uint32_t i = part.begin; i < middle; ++i) left.extend(Bounds::of(items_[i]));
        for (std::uint32_t i = middle; i < part.end; ++i) right.extend(Bounds::of(items_[i]));
        return cut(part, middle, left, right);
    }

    std::pair<Part, Part> cut(const Part& part, std::uint32_t middle, const Bounds& left, const Bounds& right) const {
        std::uint32_t primitives = 0;
        for (std::uint32_t i = part.begin; i < middle; ++i) primitives += items_[i].count;
        return {{part.begin, middle, part.first, primitives, part.depth + 1, left},
                {middle, part.end, part.first + primitives, part.primitives - primitives, part.depth + 1, right}};
    }

    // ---- Top and subtrees become one array: the top, then the subtrees from left to right, each from its root down.

    void assemble() {
        std::vector<std::uint32_t> offsets;
        offsets.reserve(jobs_.size());
        std::uint64_t total = top_.size();
        for (const Job& job : jobs_) {
            offsets.push_back(static_cast<std::uint32_t>(total));
            total += job.pairs.size();
        }
        tree_.pairs.resize(total);
        parallel_.for_each(jobs_.size(), [&](std::uint64_t i) {
            Job& job = jobs_[i];
            const std::uint32_t offset = offsets[i];
            for (std::size_t p = 0; p < job.pairs.size(); ++p) {
                BvhPair& pair = tree_.pairs[offset + p] = job.pairs[p];
                for (BvhNode& node : pair.child) {
                    if (!node.is_leaf()) node.first += offset;
                }
            }
            BvhNode& root = job.child == no_axis ? tree_.root : top_[job.pair].child[job.child];
            if (!root.is_leaf()) root.first += offset;
            job.pairs = {};
        });
        std::copy(top_.begin(), top_.end(), tree_.pairs.begin());
    }

    Clusters& clusters_;
    std::vector<BuildItem>& items_;
    const TreeCosts& costs_;
    const Parallel& parallel_;
    const std::function<void(std::uint64_t)>& report_;
    BvhTree& tree_;
    std::vector<BvhPair> top_;
    std::vector<Job> jobs_;
};

} // namespace

void build_top_down(Clusters& clusters, const Bounds& bounds, const TreeCosts& costs, const Parallel& parallel,
                    const std::function<void(std::uint64_t)>& report, BvhTree& tree) {
    TopDownBuilder(clusters, costs, parallel, report, tree).build(bounds);
}

} // namespace raywise
