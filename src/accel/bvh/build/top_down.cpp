#include "accel/bvh/build/top_down.h"

#include "accel/bvh/build/kernels.h"
#include "accel/bvh/build/parts.h"
#include "base/page_array.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

namespace raywise {
namespace {

// Up to so many clusters, or that part of all, a thread builds the whole subtree; above, all threads share the work on
// one node.
constexpr std::uint32_t least_job_size = 512;
constexpr std::uint32_t jobs_wanted = 64;

// Parts of so few clusters are split by what the clusters were merged from, pairs of primitives at most.
constexpr std::uint32_t open_below = 128;

// One level for the two primitives of a pair. A part that is opened has up to 2^opened_log times as many items.
constexpr int opened_log = Clusters::most_rounds;
constexpr int max_depth = bvh_max_depth - 1;

// The part of the tree that a thread builds alone. Pairs are numbered from 0 until all parts are put together.
class SubtreeBuilder {
public:
    SubtreeBuilder(const Clusters& clusters, const TreeCosts& costs, std::uint32_t* references)
        : clusters_(clusters), costs_(costs), references_(references) {}

    BvhNode build(const Part& part, BuildItem* items) {
        scratch_.resize(part.count());
        pairs_.reserve(part.primitives / std::max(2u, costs_.block_size));
        return build_node(part, items, false);
    }
    PageVector<BvhPair>& pairs() { return pairs_; }

private:
    BvhNode build_node(const Part& part, BuildItem* items, bool opened) {
        if (!opened && part.count() <= open_below) return build_opened(part, items);
        if (part.count() == 1) return build_pair(part, items[part.begin]);
        Halves halves;
        if (!PartSplitter(items, scratch_.data(), costs_, opened ? max_depth : max_depth - opened_log)
                 .split(part, halves)) {
            return make_leaf(part, items);
        }
        const auto pair = static_cast<std::uint32_t>(pairs_.size());
        pairs_.emplace_back();
        const BvhNode left = build_node(halves.first, items, opened);
        const BvhNode right = build_node(halves.second, items, opened);
        pairs_[pair].child[0] = left;
        pairs_[pair].child[1] = right;
        return make_node(part.bounds, pair, 0);
    }

    BvhNode make_leaf(const Part& part, const BuildItem* items) {
        std::uint32_t* next = references_ + part.first;
        for (std::uint32_t i = part.begin; i < part.end; ++i) next = clusters_.emit_primitives(items[i], next);
        return make_node(part.bounds, part.first, part.primitives);
    }

    // One or two primitives.
    BvhNode build_pair(const Part& part, const BuildItem& item) {
        if (item.count == 1) return make_leaf(part, &item - part.begin);
        const std::array<const BuildItem*, 2> references = clusters_.references(item);
        const Bounds children[2] = {Bounds::of(*references[0]), Bounds::of(*references[1])};
        const double split = costs_.node * part.bounds.half_area() +
                             costs_.leaf(1) * (children[0].half_area() + children[1].half_area());
        if (costs_.max_leaf_size >= 2 && costs_.leaf(2) * part.bounds.half_area() <= split) {
            return make_leaf(part, &item - part.begin);
        }
        clusters_.emit_primitives(item, references_ + part.first);
        const auto pair = static_cast<std::uint32_t>(pairs_.size());
        pairs_.emplace_back();
        for (std::uint32_t child = 0; child < 2; ++child) {
            pairs_[pair].child[child] = make_node(children[child], part.first + child, 1);
        }
        return make_node(part.bounds, pair, 0);
    }

    BvhNode build_opened(const Part& closed, const BuildItem* items) {
        opened_.clear();
        for (std::uint32_t i = closed.begin; i < closed.end; ++i) clusters_.open(items[i], opened_);
        Part part = closed;
        part.begin = 0;
        part.end = static_cast<std::uint32_t>(opened_.size());
        part.centroids = Bounds::none();
        for (const BuildItem& item : opened_) part.centroids.extend(Bounds::of_centroid(item));
        if (scratch_.size() < opened_.size()) scratch_.resize(opened_.size());
        return build_node(part, opened_.data(), true);
    }

    const Clusters& clusters_;
    const TreeCosts& costs_;
    std::uint32_t* const references_;
    PageVector<BuildItem> scratch_;
    PageVector<BuildItem> opened_;
    PageVector<BvhPair> pairs_;
};

class TopDownBuilder {
public:
    TopDownBuilder(Clusters& clusters, const TreeCosts& costs, const Parallel& parallel,
                   const std::function<void(std::uint64_t)>& report, BvhTree& tree)
        : clusters_(clusters),
          items_(clusters.items()),
          costs_(costs),
          parallel_(parallel),
          report_(report),
          tree_(tree),
          job_size_(std::max(least_job_size, static_cast<std::uint32_t>(items_.size()) / jobs_wanted)) {}

    void build(const Bounds& bounds) {
        split_top(bounds);
        build_jobs();
        clusters_.release(); // before the tree needs memory twice
        assemble();
    }

private:
    struct Job {
        Part part;
        std::uint32_t pair; // where its root goes: a child of a top pair
        int child;
        PageVector<BvhPair> pairs;
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
        Part root{0, count, 0, primitives, 0, bounds, Bounds::none()};
        for (const BuildItem& item : items_) root.centroids.extend(Bounds::of_centroid(item));
        PageVector<BuildItem> scratch(count <= job_size_ ? 0 : count);
        std::vector<Open> open{{root, 0, no_axis}};
        while (!open.empty()) {
            const Open node = open.back();
            open.pop_back();
            if (node.part.count() <= job_size_) {
                jobs_.push_back({node.part, node.pair, node.child, {}});
                continue;
            }
            const auto pair = static_cast<std::uint32_t>(top_.size());
            top_.emplace_back();
            place(node.pair, node.child, make_node(node.part.bounds, pair, 0));
            const auto [left, right] =
                split_shared(node.part, PartSplitter(items_.data(), scratch.data(), costs_, max_depth - opened_log));
            open.push_back({right, pair, 1});
            open.push_back({left, pair, 0});
        }
    }

    void place(std::uint32_t pair, int child, const BvhNode& node) {
        (child == no_axis ? tree_.root : top_[pair].child[child]) = node;
    }

    Halves split_shared(const Part& part, const PartSplitter& splitter) {
        report_(0); // large scenes take a while; whoever wants to stop is heard
        if (splitter.must_halve(part)) return splitter.halve(part);
        const Binning binning(part.centroids, Bins::count_for(part.count()));
        Bins bins(binning.count());
        std::mutex mutex;
        // Minima, maxima and counts do not depend on how the part was cut.
        parallel_.for_blocks(part.count(), 4096, [&](std::uint64_t begin, std::uint64_t end) {
            Bins piece(binning.count());
            fill_bins(items_.data() + part.begin + begin, static_cast<std::uint32_t>(end - begin), binning, piece);
            const std::lock_guard lock(mutex);
            bins.add(piece);
        });
        const BinSplit split = best_split(bins, part.bounds, costs_);
        return split.axis == no_axis ? splitter.halve(part) : splitter.divide(part, split, binning);
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
            SubtreeBuilder builder(clusters_, costs_, tree_.references.data());
            place(job.pair, job.child, builder.build(job.part, items_.data()));
            job.pairs = std::move(builder.pairs());
            report_(job.part.primitives);
        });
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
    PageVector<BuildItem>& items_;
    const TreeCosts& costs_;
    const Parallel& parallel_;
    const std::function<void(std::uint64_t)>& report_;
    BvhTree& tree_;
    const std::uint32_t job_size_;
    PageVector<BvhPair> top_;
    std::vector<Job> jobs_;
};

} // namespace

void build_top_down(Clusters& clusters, const Bounds& bounds, const TreeCosts& costs, const Parallel& parallel,
                    const std::function<void(std::uint64_t)>& report, BvhTree& tree) {
    TopDownBuilder(clusters, costs, parallel, report, tree).build(bounds);
}

} // namespace raywise
