// The ways in which a ray is made ready for float32: in vectors, of the best instruction set of this machine, as traversals do it, and the way of
// rare rays.
#pragma once

#include "ray/traversal_ray.h"

namespace raywise {

RaySetup set_up_in_vectors(const Ray& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time);
RaySetup set_up_in_vectors(const RayF& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time);

} // namespace raywise
