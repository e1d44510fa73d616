// What the one exact test of a ray against a triangle takes, without what rules triangles out before it.
#pragma once

#include "measure/library.h"
#include "measure/timing.h"

namespace raywise::calibration {

// Nanoseconds for each triangle that is looked at and missed: what trees do in their leaves. The rays pass the edge of many copies of one
// triangle so closely that float32 cannot tell, and float64 can.
Timing measure_exact_test(const rw_profile* profile, const TimingLimits& limits, Clock clock);

} // namespace raywise::calibration
