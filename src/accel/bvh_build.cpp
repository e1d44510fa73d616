#include "accel/bvh_build.h"

#include "accel/scene_frame.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

namespace raywise {
namespace {

// A larger node is split even where the heuristic would rather test all its primitives.
constexpr std::uint32_t max_leaf_size = 16;

// Nodes of at most so many primitives try every split of the sorted centroids instead of bins.
constexpr std::uint32_t sweep_size = 4;

// Up to so many primitives a thread builds the whole subtree; above, all threads share the work on one node. It depends
// on nothing but the scene, and neither does the tree therefore.
constexpr std::uint32_t job_size = 4096;

constexpr std::uint32_t report_size = 65536; // primitives between two reports of progress

// Bins on each axis: the more primitives, the more it pays to look closely.
constexpr int max_bin_count = 32;
constexpr int bins_for(std::uint32_t primitives) { return primitives < 32 ? 8 : primitives < 512 ? 16 : max_bin_count; }

// A primitive while the tree is built. Its centroid is its box's.
struct BuildReference {
    float lower[3];
    float upper[3];
    std::uint32_t primitive;

    float centroid(int axis) const { return 0.5f * lower[axis] + 0.5f * upper[axis]; } // does not overflow
};

// Without initial values: arrays of bounds are made for every small node.
struct Bounds {
    float lower[3];
    float upper[3];

    static constexpr Bounds none() {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    }

    template <class Other>
    void extend(const Other& other) {
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis] = other.lower[axis] < lower[axis] ? other.lower[axis] : lower[axis];
            upper[axis] = other.upper[axis] > upper[axis] ? other.upper[axis] : upper[axis];
        }
    }
    // In double, where the products of float32 neither over- nor underflow. Not for empty bounds.
    double half_area() const {
        const double x = static_cast<double>(upper[0]) - static_cast<double>(lower[0]);
        const double y = static_cast<double>(upper[1]) - static_cast<double>(lower[1]);
        const double z = static_cast<double>(upper[2]) - static_cast<double>(lower[2]);
        return x * y + y * z + z * x;
    }
};

// Of centroids.
struct CentroidBounds : Bounds {
    CentroidBounds() : Bounds(none()) {}

    using Bounds::extend;
    void extend(const BuildReference& reference) {
        for (int axis = 0; axis < 3; ++axis) {
            const float c = reference.centroid(axis);
            lower[axis] = c < lower[axis] ? c : lower[axis];
            upper[axis] = c > upper[axis] ? c : upper[axis];
        }
    }
    float extent(int axis) const { return upper[axis] - lower[axis]; }
    int longest_axis() const {
        const int xy = extent(0) >= extent(1) ? 0 : 1;
        return extent(xy) >= extent(2) ? xy : 2;
    }
};

// From a centroid to its bin on each axis; monotone. An axis on which the centroids agree, or are so close or so far
// apart that float32 cannot divide the axis, has the one bin 0.
class Binning {
public:
    Binning(const CentroidBounds& centroids, int count) : count_(count) {
        for (int axis = 0; axis < 3; ++axis) {
            const float extent = centroids.extent(axis);
            const bool divides = extent > 1e-36f && extent <= std::numeric_limits<float>::max();
            lower_[axis] = divides ? centroids.lower[axis] : 0.0f; // no infinite difference
            scale_[axis] = divides ? static_cast<float>(count) / extent : 0.0f;
        }
    }
    int bin(const BuildReference& reference, int axis) const {
        const int bin = static_cast<int>((reference.centroid(axis) - lower_[axis]) * scale_[axis]);
        return bin < count_ ? bin : count_ - 1;
    }
    int count() const { return count_; }

private:
    int count_;
    float lower_[3];
    float scale_[3];
};

struct Bin {
    Bounds bounds;
    std::uint32_t count;

    static constexpr Bin none() { return {Bounds::none(), 0}; }
};

// The bins in use, of each axis.
struct Bins {
    explicit Bins(int bin_count) : count(bin_count) {
        for (auto& axis : bins) std::fill_n(axis.begin(), count, Bin::none());
    }

    int count;
    std::array<std::array<Bin, max_bin_count>, 3> bins;

    void add(const BuildReference& reference, const Binning& binning) {
        for (int axis = 0; axis < 3; ++axis) {
            const int bin = binning.bin(reference, axis);
            at(axis, bin).bounds.extend(reference);
            ++at(axis, bin).count;
        }
    }
    void add(const Bins& other) {
        for (int axis = 0; axis < 3; ++axis) {
            for (int bin = 0; bin < count; ++bin) {
                at(axis, bin).bounds.extend(other.at(axis, bin).bounds);
                at(axis, bin).count += other.at(axis, bin).count;
            }
        }
    }
    Bin& at(int axis, int bin) { return bins[static_cast<std::size_t>(axis)][static_cast<std::size_t>(bin)]; }
    const Bin& at(int axis, int bin) const {
        return bins[static_cast<std::size_t>(axis)][static_cast<std::size_t>(bin)];
    }
};

// A node to be built: references [begin, end).
struct Range {
    std::uint32_t begin;
    std::uint32_t end;
    int depth;
    Bounds bounds;

    std::uint32_t count() const { return end - begin; }
};

constexpr int no_axis = -1;

// How to split a node. `weight` is the sum over both children of half area times number of primitives.
struct Split {
    double weight = std::numeric_limits<double>::infinity();
    int axis = no_axis;
    std::uint32_t position = 0; // the first bin, or sorted reference, on the right
    Bounds left = Bounds::none();
    Bounds right = Bounds::none();
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

class BvhBuilder {
public:
    BvhBuilder(const BuildInput& input, double progress_end) : input_(input), progress_end_(progress_end) {}

    BvhTree build() {
        gather();
        if (references_.empty()) return std::move(tree_);
        split_top();
        build_jobs();
        assemble();
        return std::move(tree_);
    }

private:
    // The part of the tree that a thread builds alone. Its pairs are numbered from 0 until it is assembled.
    struct Job {
        Range range;
        std::uint32_t pair; // where its root goes: a child of a top pair
        int child;
        std::vector<BvhPair> pairs;
    };

    // ---- Progress. Each primitive is reported once where it is gathered, for the root's bounds, in its job and in the
    // end, and twice on every level of the top. Taken for balanced; a deeper top reaches the end too early and stays
    // there.

    void report(std::uint64_t primitives) {
        const double work = static_cast<double>(done_ += primitives);
        const double whole = static_cast<double>(references_.size()) * (4.0 + 2.0 * ceil_log2(count() / job_size + 1));
        input_.progress.report(progress_end_ * std::min(1.0, work / whole), "bvh");
    }
    std::uint32_t count() const { return static_cast<std::uint32_t>(references_.size()); }

    // ---- References.

    void gather() {
        const Primitives& primitives = input_.primitives;
        std::vector<std::uint32_t> hittable; // empty when all are
        if (primitives.hittable_count() != primitives.count()) {
            hittable.reserve(primitives.hittable_count());
            for (std::uint32_t i = 0; i < primitives.count(); ++i) {
                if (primitives.is_hittable(i)) hittable.push_back(i);
            }
        }
        references_.resize(primitives.hittable_count());
        if (references_.empty()) return;

        tree_.center = SceneFrame::choose_center(primitives.bounds());
        for_chunks(0, count(), [&](std::uint32_t begin, std::uint32_t end) {
            for (std::uint32_t i = begin; i < end; ++i) {
                const std::uint32_t primitive = hittable.empty() ? i : hittable[i];
                const Box box = primitives.box(primitive);
                const BoxF rounded = round_outwards({box.lower - tree_.center, box.upper - tree_.center});
                BuildReference& reference = references_[i];
                for (int axis = 0; axis < 3; ++axis) {
                    reference.lower[axis] = rounded.lower[axis];
                    reference.upper[axis] = rounded.upper[axis];
                }
                reference.primitive = primitive;
            }
        });
    }

    // Calls body(begin, end) for pieces of at most report_size, in parallel, and reports each.
    template <class Body>
    void for_chunks(std::uint32_t begin, std::uint32_t end, const Body& body) {
        input_.parallel.for_blocks(end - begin, 4096, [&](std::uint64_t first, std::uint64_t last) {
            for (std::uint64_t b = first; b < last; b += report_size) {
                const std::uint64_t e = std::min<std::uint64_t>(last, b + report_size);
                body(static_cast<std::uint32_t>(begin + b), static_cast<std::uint32_t>(begin + e));
                report(e - b);
            }
        });
    }

    // ---- The top of the tree: one node after the other, each with all threads.

    void split_top() {
        Range root{0, count(), 0, Bounds::none()};
        reduce(
            root, Bounds::none(), [&](Bounds& bounds, const BuildReference& reference) { bounds.extend(reference); },
            [](Bounds& bounds, const Bounds& other) { bounds.extend(other); }, root.bounds);

        struct Open {
            Range range;
            std::uint32_t pair;
            int child;
        };
        std::vector<Open> open{{root, 0, no_axis}};
        while (!open.empty()) {
            const Open node = open.back();
            open.pop_back();
            if (node.range.count() <= job_size) {
                jobs_.push_back({node.range, node.pair, node.child, {}});
                continue;
            }
            const auto pair = static_cast<std::uint32_t>(top_.size());
            top_.emplace_back();
            place(node.pair, node.child, make_node(node.range.bounds, pair, 0));
            const auto [left, right] = split_shared(node.range);
            open.push_back({right, pair, 1});
            open.push_back({left, pair, 0});
        }
    }

    void place(std::uint32_t pair, int child, const BvhNode& node) {
        (child == no_axis ? tree_.root : top_[pair].child[child]) = node;
    }

    // Folds all references of a range. Pieces are folded on their own and then merged: minima, maxima and counts do not
    // depend on how the range was cut.
    template <class Result, class Add, class Merge>
    void reduce(const Range& range, const Result& initial, const Add& add, const Merge& merge, Result& result) {
        std::mutex mutex;
        result = initial;
        for_chunks(range.begin, range.end, [&](std::uint32_t begin, std::uint32_t end) {
            Result piece = initial;
            for (std::uint32_t i = begin; i < end; ++i) add(piece, references_[i]);
            const std::lock_guard lock(mutex);
            merge(result, piece);
        });
    }

    std::pair<Range, Range> split_shared(const Range& range) {
        CentroidBounds centroids;
        reduce(
            range, CentroidBounds{}, [](CentroidBounds& c, const BuildReference& reference) { c.extend(reference); },
            [](CentroidBounds& c, const CentroidBounds& other) { c.extend(other); }, centroids);
        if (must_halve(range)) return halve(range, centroids);
        const Binning binning(centroids, bins_for(range.count()));
        Bins bins(binning.count());
        reduce(
            range, Bins(binning.count()), [&](Bins& b, const BuildReference& reference) { b.add(reference, binning); },
            [](Bins& b, const Bins& other) { b.add(other); }, bins);
        const Split split = best_split(bins);
        return split.axis == no_axis ? halve(range, centroids) : divide(range, split, binning);
    }

    // ---- Subtrees.

    void build_jobs() {
        input_.parallel.for_each(jobs_.size(), [&](std::uint64_t i) {
            Job& job = jobs_[i];
            job.pairs.reserve(job.range.count() / 2);
            job.pairs.emplace_back(); // becomes the root's pair when the root is split
            const BvhNode root = build_node(job.range, job, 0);
            if (root.is_leaf()) job.pairs.clear();
            place(job.pair, job.child, root);
            report(job.range.count());
        });
    }

    // Builds the subtree. `own_pair`: a pair already there for the children of this node.
    BvhNode build_node(const Range& range, Job& job, std::uint32_t own_pair) {
        std::pair<Range, Range> halves;
        if (range.count() == 1 || !split(range, halves)) return make_node(range.bounds, range.begin, range.count());
        for (int child = 0; child < 2; ++child) {
            const Range& part = child == 0 ? halves.first : halves.second;
            // A pair is made only for nodes that will surely be split or are likely to; a leaf's is given back.
            const auto pair = static_cast<std::uint32_t>(job.pairs.size());
            if (part.count() > 1) job.pairs.emplace_back();
            const BvhNode node = build_node(part, job, pair);
            if (part.count() > 1 && node.is_leaf()) job.pairs.pop_back();
            job.pairs[own_pair].child[child] = node;
        }
        return make_node(range.bounds, own_pair, 0);
    }

    // Splits a range unless it is better off as a leaf.
    bool split(const Range& range, std::pair<Range, Range>& halves) {
        CentroidBounds centroids;
        for (std::uint32_t i = range.begin; i < range.end; ++i) centroids.extend(references_[i]);
        if (must_halve(range)) {
            if (range.count() <= max_leaf_size) return false;
            halves = halve(range, centroids);
            return true;
        }
        if (range.count() <= sweep_size) {
            const Split split = sweep(range, centroids);
            if (!worth_splitting(range, split)) return false;
            sort(range, split.axis);
            halves = cut(range, range.begin + split.position, split.left, split.right);
            return true;
        }
        const Binning binning(centroids, bins_for(range.count()));
        Bins bins(binning.count());
        for (std::uint32_t i = range.begin; i < range.end; ++i) bins.add(references_[i], binning);
        const Split split = best_split(bins);
        if (range.count() <= max_leaf_size && !worth_splitting(range, split)) return false;
        halves = split.axis == no_axis ? halve(range, centroids) : divide(range, split, binning);
        return true;
    }

    // The surface area heuristic (Goldsmith and Salmon 1987, MacDonald and Booth 1990): a ray that meets the node meets
    // a child with the ratio of their areas as probability.
    bool worth_splitting(const Range& range, const Split& split) const {
        if (split.axis == no_axis) return false;
        const double area = range.bounds.half_area();
        const double leaf = input_.costs.primitive_test_ns * area * range.count();
        return input_.costs.node_step_ns * area + input_.costs.primitive_test_ns * split.weight < leaf;
    }

    // ---- Splits.

    // A split by the heuristic may leave nearly all primitives on one side. It is allowed as long as halving from there
    // on would still end in time: depth + ceil_log2(count) <= bvh_max_depth holds for the root (count < 2^32) and for
    // the children of every node, because halving lowers the logarithm by one where depth + 1 would exceed the bound.
    // So a node at depth bvh_max_depth has one primitive, and is a leaf.
    static bool must_halve(const Range& range) { return range.depth + ceil_log2(range.count()) >= bvh_max_depth; }

    static Split best_split(const Bins& bins) {
        Split best;
        for (int axis = 0; axis < 3; ++axis) {
            // From the right: bounds and numbers of the bins from each bin on.
            std::array<Bin, max_bin_count> right;
            Bin sum = Bin::none();
            for (int bin = bins.count - 1; bin > 0; --bin) {
                sum.bounds.extend(bins.at(axis, bin).bounds);
                sum.count += bins.at(axis, bin).count;
                right[static_cast<std::size_t>(bin)] = sum;
            }
            sum = Bin::none();
            for (int bin = 1; bin < bins.count; ++bin) {
                sum.bounds.extend(bins.at(axis, bin - 1).bounds);
                sum.count += bins.at(axis, bin - 1).count;
                const Bin& rest = right[static_cast<std::size_t>(bin)];
                if (sum.count == 0 || rest.count == 0) continue;
                const double weight = sum.bounds.half_area() * sum.count + rest.bounds.half_area() * rest.count;
                if (weight < best.weight) {
                    best = {weight, axis, static_cast<std::uint32_t>(bin), sum.bounds, rest.bounds};
                }
            }
        }
        return best;
    }

    // Every split of the references sorted by centroid. Leaves them as they were.
    Split sweep(const Range& range, const CentroidBounds& centroids) const {
        const BuildReference* const references = &references_[range.begin];
        const std::uint32_t n = range.count();
        Split best;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(centroids.extent(axis) > 0.0f)) continue;
            const Order order(references, n, axis);
            std::array<Bounds, sweep_size> right;
            Bounds bounds = Bounds::none();
            for (std::uint32_t i = n - 1; i > 0; --i) {
                bounds.extend(references[order[i]]);
                right[i] = bounds;
            }
            bounds = Bounds::none();
            for (std::uint32_t i = 1; i < n; ++i) {
                bounds.extend(references[order[i - 1]]);
                const double weight = bounds.half_area() * i + right[i].half_area() * (n - i);
                if (weight < best.weight) best = {weight, axis, i, bounds, right[i]};
            }
        }
        return best;
    }

    void sort(const Range& range, int axis) {
        BuildReference* const references = &references_[range.begin];
        const std::uint32_t n = range.count();
        const Order order(references, n, axis);
        std::array<BuildReference, sweep_size> sorted;
        for (std::uint32_t i = 0; i < n; ++i) sorted[i] = references[order[i]];
        std::copy_n(sorted.begin(), n, references);
    }

    // The order of a few references by centroid, found by insertion; the number of the primitive makes it, and with it
    // the tree, independent of what was there before.
    class Order {
    public:
        Order(const BuildReference* references, std::uint32_t n, int axis) {
            for (std::uint32_t i = 0; i < n; ++i) {
                const Key key{references[i].centroid(axis), references[i].primitive, i};
                std::uint32_t place = i;
                for (; place > 0 && key < keys_[place - 1]; --place) keys_[place] = keys_[place - 1];
                keys_[place] = key;
            }
        }
        std::uint32_t operator[](std::uint32_t i) const { return keys_[i].index; }

    private:
        struct Key {
            float centroid;
            std::uint32_t primitive;
            std::uint32_t index;

            bool operator<(const Key& other) const {
                return centroid < other.centroid || (centroid == other.centroid && primitive < other.primitive);
            }
        };
        std::array<Key, sweep_size> keys_;
    };

    static bool before(const BuildReference& a, const BuildReference& b, int axis) {
        const float ca = a.centroid(axis);
        const float cb = b.centroid(axis);
        return ca < cb || (ca == cb && a.primitive < b.primitive);
    }

    std::pair<Range, Range> divide(const Range& range, const Split& split, const Binning& binning) {
        const auto middle = std::partition(
            references_.begin() + range.begin, references_.begin() + range.end, [&](const BuildReference& reference) {
                return binning.bin(reference, split.axis) < static_cast<int>(split.position);
            });
        return cut(range, static_cast<std::uint32_t>(middle - references_.begin()), split.left, split.right);
    }

    // In the middle of the sorted centroids; where they all coincide, of the numbers.
    std::pair<Range, Range> halve(const Range& range, const CentroidBounds& centroids) {
        const int axis = centroids.longest_axis();
        const std::uint32_t middle = range.begin + range.count() / 2;
        std::nth_element(references_.begin() + range.begin, references_.begin() + middle,
                         references_.begin() + range.end,
                         [axis](const BuildReference& a, const BuildReference& b) { return before(a, b, axis); });
        Bounds left = Bounds::none();
        Bounds right = Bounds::none();
        for (std::uint32_t i = range.begin; i < middle; ++i) left.extend(references_[i]);
        for (std::uint32_t i = middle; i < range.end; ++i) right.extend(references_[i]);
        return cut(range, middle, left, right);
    }

    static std::pair<Range, Range> cut(const Range& range, std::uint32_t middle, const Bounds& left,
                                       const Bounds& right) {
        return {{range.begin, middle, range.depth + 1, left}, {middle, range.end, range.depth + 1, right}};
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
        input_.parallel.for_each(jobs_.size(), [&](std::uint64_t i) {
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

        tree_.references.resize(references_.size());
        for_chunks(0, count(), [&](std::uint32_t begin, std::uint32_t end) {
            for (std::uint32_t i = begin; i < end; ++i) tree_.references[i] = references_[i].primitive;
        });
    }

    const BuildInput& input_;
    const double progress_end_;
    BvhTree tree_;
    std::vector<BuildReference> references_;
    std::vector<BvhPair> top_;
    std::vector<Job> jobs_;
    std::atomic<std::uint64_t> done_{0};
};

} // namespace

BvhTree build_bvh(const BuildInput& input, double progress_end) { return BvhBuilder(input, progress_end).build(); }

} // namespace raywise
