#include "accel/bvh.h"

#include "accel/wide_bvh_kernels.h"

namespace raywise {
namespace {

constexpr double binary_part = 0.85; // of the time that building takes

} // namespace

Bvh::Bvh(const BuildInput& input)
    : primitives_(input.primitives), tree_(widen(build_bvh(input, binary_part), input, binary_part)) {}

SurfaceHit Bvh::closest(const PreparedRay& ray) const { return closest_hit({tree_, primitives_}, ray); }
bool Bvh::any(const PreparedRay& ray) const { return any_hit({tree_, primitives_}, ray); }

SurfaceHit Bvh::closest(const UnpreparedRay& ray) const { return closest_hit({tree_, primitives_}, ray); }
bool Bvh::any(const UnpreparedRay& ray) const { return any_hit({tree_, primitives_}, ray); }

void Bvh::all(const PreparedRay& ray, std::vector<PrimitiveHit>& hits) const {
    all_hits({tree_, primitives_}, ray, hits);
}

} // namespace raywise
