// Every primitive in turn: the best choice for few rays and for tiny scenes.
//
// For very few rays nothing is built: the triangles are read from the caller's arrays. For more they are gathered at the commit, in
// float32, in blocks that vector registers compare at once. A test in float32 rules out what is certainly missed, the exact one decides
// about the rest; so all ways of reading answer alike.
#pragma once

#include "accel/accel.h"
#include "accel/scan/linear_scan_kernels.h"
#include "base/page_array.h"
#include "ray/scene_frame.h"

namespace raywise {

class LinearScan final : public Accel {
public:
    explicit LinearScan(const BuildInput& input);

    PrimitiveHit closest(const Ray& ray, const Query& query) const override;
    bool any(const Ray& ray, const Query& query) const override;
    void all(const Ray& ray, const Query& query, std::vector<PrimitiveHit>& hits) const override;
    std::size_t rays_at_a_time() const override { return 64; } // what they share is paid for with 8 already
    std::size_t rays_worth_thread() const override;
    void closest_many(const RayPacket& rays, PrimitiveHit* hits, Scratch& scratch) const override;
    void any_many(const RayPacket& rays, bool* found, Scratch& scratch) const override;
    void closest_many_f32(const RayPacketF& rays, PrimitiveHit* hits, Scratch& scratch) const override;
    void any_many_f32(const RayPacketF& rays, bool* found, Scratch& scratch) const override;

    std::size_t bytes() const override { return sizeof *this + blocks_.bytes(); }
    bool is_gathered() const { return !blocks_.empty(); }

private:
    void gather(const BuildInput& input);
    ScannedScene scanned() const;

    const Primitives& primitives_;
    SceneFrame frame_;
    PageArray<float> blocks_; // empty: the triangles are read from the meshes
};

} // namespace raywise
