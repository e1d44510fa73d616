#include "accel/bvh_build.h"

#include "accel/bvh_build_clusters.h"
#include "accel/bvh_build_costs.h"
#include "accel/bvh_build_morton.h"
#include "accel/bvh_build_references.h"
#include "accel/bvh_build_top_down.h"
#include "accel/bvh_spatial_splits.h"
#include "accel/scene_frame.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace raywise {

BvhTree build_bvh(const BuildInput& input, double progress_end, const BvhBuildOptions& options) {
    BvhTree tree;
    if (input.primitives.hittable_count() == 0) return tree;

    // Each primitive is reported once where it is gathered, where it is clustered, and in the end.
    std::atomic<std::uint64_t> done{0};
    const double whole = 3.0 * static_cast<double>(input.primitives.hittable_count());
    const std::function<void(std::uint64_t)> report = [&](std::uint64_t primitives) {
        const double work = static_cast<double>(done += primitives);
        input.progress.report(progress_end * std::min(1.0, work / whole), "bvh");
    };

    const TreeCosts costs(input, options);
    tree.center = SceneFrame::choose_center(input.primitives.bounds());
    BuildReferences references = gather_references(input, tree.center, report);
    if (options.quality == BvhQuality::high) {
        build_with_spatial_splits(std::move(references), input, costs, report, tree);
        return tree;
    }
    const Bounds bounds = references.bounds;
    const std::uint32_t count = references.count;
    auto order = morton_order(references.items.data(), std::move(references.keys), count, input.parallel);
    Clusters clusters(std::move(references.items), std::move(order), count);
    clusters.build(bounds, input.parallel, report);
    tree.references.resize(count);
    build_top_down(clusters, bounds, costs, input.parallel, report, tree);
    return tree;
}

} // namespace raywise
