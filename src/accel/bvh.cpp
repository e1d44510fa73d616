#include "accel/bvh.h"

#include "accel/wide_bvh_kernels.h"

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

void Bvh::all(const PreparedRay& ray, std::vector<PrimitiveHit>& hits) const {
    all_hits({tree_, primitives_}, ray, hits);
}

} // namespace raywise
