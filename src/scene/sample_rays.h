// Rays made up for a scene, when the caller has given none to time a structure with.
#pragma once

#include "accel/accel.h"
#include "geometry/primitives.h"
#include "model/workload.h"
#include "ray/ray.h"

#include <optional>
#include <vector>

namespace raywise {

// At most this many rays are timed: Hapala et al. 2011, section 3, ask for 100 to 1000.
inline constexpr std::size_t sample_limit = 1000;

// The same rays for the same scene every time. With a view: rays of the view.
std::vector<Ray> make_sample_rays(const Primitives& primitives, RayKind kind, const std::optional<ViewFrame>& view);

} // namespace raywise
