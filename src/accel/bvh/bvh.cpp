#include "accel/bvh/bvh.h"

#include "accel/bvh/build/build.h"
#include "accel/bvh/build/wide.h"
#include "accel/bvh/refit.h"
#include "accel/bvh/traverse.h"

#include <memory>
#include <optional>
#include <utility>

namespace raywise {
namespace {

// Of the time that building takes.
constexpr double binary_part(BvhQuality quality) { return quality == BvhQuality::high ? 0.97 : 0.8; }

// A block of triangles takes one comparison of eight at a time, as a node does of its boxes, and about as long.
BvhBuildOptions options(BvhQuality quality) {
    BvhBuildOptions result;
    result.max_leaf_size = triangle_block_size;
    result.block_size = triangle_block_size;
    result.costs = BuildCosts{1.0, 1.0};
    result.quality = quality;
    return result;
}

} // namespace

Bvh::Bvh(const BuildInput& input, BvhQuality quality)
    : primitives_(input.primitives),
      tree_(widen(build_bvh(input, binary_part(quality), options(quality)), input, binary_part(quality))) {}

PrimitiveHit Bvh::closest(const Ray& ray, const Query& query) const { return trace_closest(tree_, ray, query); }
bool Bvh::any(const Ray& ray, const Query& query) const { return trace_any(tree_, ray, query); }
PrimitiveHit Bvh::closest_f32(const RayF& ray, const Query& query) const { return trace_closest(tree_, ray, query); }
bool Bvh::any_f32(const RayF& ray, const Query& query) const { return trace_any(tree_, ray, query); }

void Bvh::all(const Ray& ray, const Query& query, std::vector<PrimitiveHit>& hits) const {
    AllCollector collector(ray, query, hits);
    trace_all(tree_, ray, collector);
    if (tree_.repeats) collector.remove_repeats();
}

void Bvh::closest_many(const RayPacket& rays, PrimitiveHit* hits, Scratch& scratch) const {
    trace_closest_many(tree_, rays, hits, scratch);
}

void Bvh::any_many(const RayPacket& rays, bool* found, Scratch& scratch) const {
    trace_any_many(tree_, rays, found, scratch);
}

void Bvh::closest_many_f32(const RayPacketF& rays, PrimitiveHit* hits, Scratch& scratch) const {
    trace_closest_many(tree_, rays, hits, scratch);
}

void Bvh::any_many_f32(const RayPacketF& rays, bool* found, Scratch& scratch) const {
    trace_any_many(tree_, rays, found, scratch);
}

Refitted Bvh::refitted(const BuildInput& input, double most) const {
    std::optional<WideBvh> tree = refit(tree_, primitives_, input);
    if (!tree) return {nullptr, "a triangle that could not be hit before is not in the tree", 1.0};
    // Where nothing can be hit there is no cost.
    const double cost = tree->nodes.empty() ? 1.0 : tree_cost(*tree, input.parallel) / tree->built_cost;
    if (cost > most) return {nullptr, "the boxes of the tree overlap too much", cost};
    return {std::unique_ptr<const Accel>(new Bvh(input.primitives, std::move(*tree))), "", cost};
}

} // namespace raywise
