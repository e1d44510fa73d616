// The bounding volume hierarchy in the form rays are traced in: built as a binary tree, then widened to eight children.
// BvhHigh (bvh_quality.h) and BvhMorton (bvh_morton.h) are the same of other builders.
#pragma once

#include "accel/accel.h"
#include "accel/bvh/build/build.h"
#include "accel/bvh/node.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace raywise {

class Bvh : public Accel {
public:
    explicit Bvh(const BuildInput& input) : Bvh(input, BvhQuality::fast) {}

    PrimitiveHit closest(const Ray& ray, const Query& query) const override;
    bool any(const Ray& ray, const Query& query) const override;
    PrimitiveHit closest_f32(const RayF& ray, const Query& query) const override;
    bool any_f32(const RayF& ray, const Query& query) const override;
    void all(const Ray& ray, const Query& query, std::vector<PrimitiveHit>& hits) const override;
    std::size_t rays_at_a_time() const override { return 2048; } // as many as stay in the caches
    void closest_many(const RayPacket& rays, PrimitiveHit* hits, Scratch& scratch) const override;
    void any_many(const RayPacket& rays, bool* found, Scratch& scratch) const override;
    void closest_many_f32(const RayPacketF& rays, PrimitiveHit* hits, Scratch& scratch) const override;
    void any_many_f32(const RayPacketF& rays, bool* found, Scratch& scratch) const override;

    std::size_t bytes() const override { return sizeof *this + tree_.bytes(); }
    Refitted refitted(const BuildInput& input, double most) const override;
    const WideBvh& tree() const { return tree_; }

protected:
    Bvh(const BuildInput& input, BvhQuality quality);
    Bvh(const Primitives& primitives, WideBvh tree) : primitives_(primitives), tree_(std::move(tree)) {}

private:
    const Primitives& primitives_;
    WideBvh tree_;
};

} // namespace raywise
