// How far a point is from a triangle: what libraries are allowed that do not decide by exact arithmetic.
#pragma once

#include "base/vec.h"

namespace raywise::contract {

// Rounded. A triangle without area is infinitely far away: it is never hit.
double distance(const Vec3& point, const Vec3 (&corners)[3]);

} // namespace raywise::contract
