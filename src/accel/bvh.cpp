#include "accel/bvh.h"

namespace raywise {

Bvh::Bvh(const BuildInput& input) : TraversedAccel(input.primitives), tree_(build_bvh(input)) {}

} // namespace raywise
