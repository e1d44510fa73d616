// The bounding volume hierarchy in the form rays are traced in: built as a binary tree, then widened to eight children.
// BvhHigh (bvh_quality.h) is the same of another builder.
#pragma once

#include "accel/accel.h"
#include "accel/wide_bvh.h"

#include <cstddef>
#include <vector>

namespace raywise {

class Bvh : public Accel {
public:
    explicit Bvh(const BuildInput& input) : Bvh(input, BvhQuality::fast) {}

    SurfaceHit closest(const PreparedRay& ray) const override;
    bool any(const PreparedRay& ray) const override;
    SurfaceHit closest(const UnpreparedRay& ray) const override;
    bool any(const UnpreparedRay& ray) const override;
    void all(const PreparedRay& ray, std::vector<PrimitiveHit>& hits) const override;

    std::size_t bytes() const override { return sizeof *this + tree_.bytes(); }
    const WideBvh& tree() const { return tree_; }

protected:
    Bvh(const BuildInput& input, BvhQuality quality);

private:
    const Primitives& primitives_;
    WideBvh tree_;
};

} // namespace raywise
