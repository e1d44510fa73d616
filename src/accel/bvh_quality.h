// The bounding volume hierarchy of the quality builder: slower to build, faster to trace.
#pragma once

#include "accel/bvh.h"

#include <vector>

namespace raywise {

class BvhHigh final : public Bvh {
public:
    explicit BvhHigh(const BuildInput& input) : Bvh(input, BvhQuality::high) {}

    void all(const PreparedRay& ray, std::vector<PrimitiveHit>& hits) const override;
};

} // namespace raywise
