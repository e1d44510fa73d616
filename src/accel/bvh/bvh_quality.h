// The bounding volume hierarchy of the quality builder: slower to build, faster to trace.
#pragma once

#include "accel/bvh/bvh.h"

namespace raywise {

class BvhHigh final : public Bvh {
public:
    explicit BvhHigh(const BuildInput& input) : Bvh(input, BvhQuality::high) {}
};

} // namespace raywise
