// The coordinate plane in which a polygon in space is looked at.
#pragma once

#include "base/vec.h"

#include <vector>

namespace raywise {

// Projects a polygon along the axis along which its area is seen largest, that of the largest component of its Newell normal, and
// so that it is seen counterclockwise: its signed area in the plane is above zero. The sign is exact; which of two components that
// are nearly alike is taken for the larger one may depend on rounding, the same way everywhere. A polygon whose normal is exactly
// zero is looked at as its first corner and the first two others that make a triangle with it are; where all corners are in line,
// along the axis of their smallest extent. Coordinates are kept, so that nothing rounds. corners: at least one, finite.
void project_polygon(const std::vector<Vec3>& corners, std::vector<Vec2>& points);

} // namespace raywise
