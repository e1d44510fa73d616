// The bounding volume hierarchy of the fastest builder: traced like any other, in somewhat more steps.
#pragma once

#include "accel/bvh/build/morton_tree.h"
#include "accel/bvh/bvh.h"

namespace raywise {

class BvhMorton final : public Bvh {
public:
    explicit BvhMorton(const BuildInput& input) : Bvh(input.primitives, build_morton_tree(input)) {}
};

} // namespace raywise
