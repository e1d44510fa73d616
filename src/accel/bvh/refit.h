// A tree for geometry that has moved: the same topology around new boxes (Wald, Boulos, Shirley 2007, "Ray Tracing Deformable Scenes
// using Dynamic Bounding Volume Hierarchies").
#pragma once

#include "accel/accel.h"
#include "accel/bvh/node.h"

#include <optional>

namespace raywise {

// The tree of another scene, of `others`, around the primitives of this one: the same numbers at new places. Boxes that were cut at a split
// (spatial_splits.h) become those of whole primitives. What cannot be hit any more is left out. Nothing when a primitive can be
// hit that could not be before, which therefore is not in the tree, or when there are not as many: then only building helps.
//
// Of the other scene's primitives only their number is read and which of them can be hit; their vertices may be gone.
//
// Boxes of what has moved apart overlap: tree_cost() of the result, compared with its built_cost, tells how much longer rays take.
std::optional<WideBvh> refit(const WideBvh& other, const Primitives& others, const BuildInput& input);

} // namespace raywise
