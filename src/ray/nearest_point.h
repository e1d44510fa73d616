// Where a line passes nearest to a point, for rays that start far away.
#pragma once

#include "base/vec.h"

namespace raywise {

// Moves `start` along `direction` to the point nearest to `center`, and returns how far: with one rounding of fma for each coordinate, and
// as near as the steps of that number allow, which are 2^-52 of it. So whoever wants to be nearer calls it once more.
double move_to_nearest(Vec3& start, const Vec3& direction, const Vec3& center);

} // namespace raywise
