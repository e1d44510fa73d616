#include "accel/bvh.h"

#include "accel/visitors.h"
#include "accel/wide_bvh_kernels.h"
#include "accel/wide_bvh_refit.h"

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
    result.max_leaf_size = block_size;
    result.block_size = block_size;
    result.costs = BuildCosts{1.0, 1.0};
    result.quality = quality;
    return result;
}

} // namespace

Bvh::Bvh(const BuildInput& input, BvhQuality quality)
    : primitives_(input.primitives),
      tree_(widen(build_bvh(input, binary_part(quality), options(quality)), input, binary_part(quality))) {}

SurfaceHit Bvh::closest(const PreparedRay& ray) const { return closest_hit({tree_, primitives_}, ray); }
bool Bvh::any(const PreparedRay& ray) const { return any_hit({tree_, primitives_}, ray); }

SurfaceHit Bvh::closest(const UnpreparedRay& ray) const { return closest_hit({tree_, primitives_}, ray); }
bool Bvh::any(const UnpreparedRay& ray) const { return any_hit({tree_, primitives_}, ray); }

void Bvh::closest_many(const UnpreparedRays& rays, const SurfaceHits& hits, Scratch& scratch) const {
    closest_hits({tree_, primitives_}, rays, hits, scratch);
}
void Bvh::any_many(const UnpreparedRays& rays, bool* found, Scratch& scratch) const {
    any_hits({tree_, primitives_}, rays, found, scratch);
}

void Bvh::all(const PreparedRay& ray, std::vector<PrimitiveHit>& hits) const {
    const std::size_t first = hits.size();
    all_hits({tree_, primitives_}, ray, hits);
    if (tree_.repeats) remove_repeats(hits, first);
}

Refitted Bvh::refitted(const BuildInput& input, double most) const {
    std::optional<WideBvh> tree = refit({tree_, primitives_}, input);
    if (!tree) return {nullptr, "a triangle that could not be hit before is not in the tree", 1.0};
    // Where nothing can be hit there is no cost.
    const double cost = tree->nodes.empty() ? 1.0 : tree_cost(*tree, input.parallel) / tree->built_cost;
    if (cost > most) return {nullptr, "the boxes of the tree overlap too much", cost};
    return {std::unique_ptr<const Accel>(new Bvh(input.primitives, std::move(*tree))), "", cost};
}

} // namespace raywise
