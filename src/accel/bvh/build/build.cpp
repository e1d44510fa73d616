#include "accel/bvh/build/build.h"

#include "accel/bvh/build/bounds.h"
#include "accel/bvh/build/clusters.h"
#include "accel/bvh/build/costs.h"
#include "accel/bvh/build/morton.h"
#include "accel/bvh/build/references.h"
#include "accel/bvh/build/reinsertion.h"
#include "accel/bvh/build/spatial_splits.h"
#include "accel/bvh/build/top_down.h"
#include "accel/dense_region.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <utility>

namespace raywise {
namespace {

using Report = std::function<void(std::uint64_t)>;

// Cutting primitives takes two to six times as long as not cutting them, and pays where boxes overlap much: at 0.15 (scanned
// meshes) to 0.26 (soups of small triangles) it takes 0 to 1 % off the cost of a tree, at 0.45 (long thin triangles) 6 %. Measured
// with trees after reinsertion, 2026-11-26: docs/decisions/0011-bvh-builders.md.
constexpr double overlap_to_cut = 0.35;

// References take memory too: a tree of cut primitives has to cost less by that part.
constexpr double least_gain_by_cutting = 0.01;

// What the boxes of siblings share, as a part of the boxes around both; by areas, over the whole tree.
double sibling_overlap(const BvhTree& tree) {
    double shared = 0.0;
    double whole = 0.0;
    for (const BvhPair& pair : tree.pairs) {
        const Bounds a = bounds_of(pair.child[0]);
        const Bounds b = bounds_of(pair.child[1]);
        Bounds both = a;
        both.extend(b);
        whole += both.half_area();
        const Bounds common{max_lanes(a.lower, b.lower), min_lanes(a.upper, b.upper)};
        const IntLanes apart = common.upper < common.lower;
        if ((apart[0] | apart[1] | apart[2]) == 0) shared += common.half_area();
    }
    return whole > 0.0 ? shared / whole : 0.0;
}

// Where a scene is, for its builders.
struct Place {
    SceneFrame frame;
    Box most; // around most primitives
};

Place place_of(const Primitives& primitives) {
    const DenseRegion dense = dense_region(primitives);
    return {scene_frame(primitives, dense), dense.most};
}

BvhTree build_fast(const BuildInput& input, const TreeCosts& costs, const Place& place, const Report& report) {
    BuildReferences references = gather_references(input, place.frame, place.most, report);
    const Bounds bounds = references.bounds;
    const std::uint32_t count = references.count;
    auto order = morton_order(references.items.data(), std::move(references.keys), count, input.parallel);
    Clusters clusters(std::move(references.items), std::move(order), count);
    clusters.build(bounds, input.parallel, report);
    BvhTree tree;
    tree.frame = place.frame;
    tree.references.resize(count);
    build_top_down(clusters, bounds, costs, input.parallel, report, tree);
    return tree;
}

struct TreeAndCost {
    BvhTree tree;
    double cost;
};

TreeAndCost build_from_above(double budget, const BuildInput& input, const TreeCosts& costs, const Place& place,
                             const Report& report) {
    TreeAndCost result;
    result.tree.frame = place.frame;
    build_with_spatial_splits(gather_references(input, place.frame, place.most, report), budget, input, costs, report,
                              result.tree);
    result.cost = optimise_by_reinsertion(result.tree, costs, input.parallel, report);
    return result;
}

BvhTree build_high(const BuildInput& input, const TreeCosts& costs, const Place& place, const Report& report) {
    TreeAndCost whole = build_from_above(0.0, input, costs, place, report);
    if (sibling_overlap(whole.tree) < overlap_to_cut) return std::move(whole.tree);
    TreeAndCost cut = build_from_above(split_budget, input, costs, place, report);
    const bool pays = cut.cost < (1.0 - least_gain_by_cutting) * whole.cost;
    return std::move(pays ? cut.tree : whole.tree);
}

} // namespace

BvhTree build_bvh(const BuildInput& input, double progress_end, const BvhBuildOptions& options) {
    if (input.primitives.hittable_count() == 0) return {};

    // Each primitive is reported three times for a tree, and two trees may be built for the high quality.
    std::atomic<std::uint64_t> done{0};
    const bool is_high = options.quality == BvhQuality::high;
    const double whole = (is_high ? 6.0 : 3.0) * static_cast<double>(input.primitives.hittable_count());
    const Report report = [&](std::uint64_t primitives) {
        const double work = static_cast<double>(done += primitives);
        input.progress.report(progress_end * std::min(1.0, work / whole), "bvh");
    };
    const TreeCosts costs(input, options);
    const Place place = place_of(input.primitives);
    return is_high ? build_high(input, costs, place, report) : build_fast(input, costs, place, report);
}

} // namespace raywise
