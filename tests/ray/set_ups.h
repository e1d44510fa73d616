// A ray made ready for float32 as traversals do it: in vectors of the best instruction set of this machine (ray/traversal_ray-inl.h).
#pragma once

#include "ray/traversal_ray.h"

namespace raywise {

RaySetup set_up_in_vectors(const Ray& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time);
RaySetup set_up_in_vectors(const RayF& ray, const SceneFrame& frame, TraversalRay& result, RayTime& time);

} // namespace raywise
