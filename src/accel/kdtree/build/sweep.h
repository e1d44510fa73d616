// The best plane of all (Wald and Havran 2006, algorithm 5).
#pragma once

#include "accel/kdtree/build/costs.h"
#include "accel/kdtree/build/events.h"
#include "accel/kdtree/build/task.h"

#include <cstddef>

namespace raywise {

// Takes the plane that costs least across an axis for `best`, if it costs less than that. events: sorted, at least one.
void sweep_axis(const KdEvent* first, std::size_t count, int axis, const KdTask& task, const KdCosts& costs,
                KdPlane& best);

} // namespace raywise
