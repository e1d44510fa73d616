// A look at some of a scene's triangles, for what costs depend on.
#pragma once

#include "geometry/primitives.h"
#include "model/scene_features.h"

#include <cstdint>

namespace raywise {

// The features of a scene, as so many of its triangles tell, taken from all over the scene; 0: typical_features(). Nothing is kept, and the same
// scene looks the same each time.
SceneFeatures look_at(const Primitives& primitives, std::uint32_t sampled);

} // namespace raywise
