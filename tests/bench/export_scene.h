// A scene and its rays in a file, for benchmarks in other languages.
#pragma once

#include "bench/session.h"

#include <cstdint>
#include <string>

namespace raywise::bench {

// Writes folder/NAME.scene: vertices and indices, then origin, direction, tmin and tmax of so many rays of each kind in the order of
// workloads::ray_distributions(); arrays as binary.h has them.
void export_scene(SceneUnderTest& scene, const std::string& folder, std::uint64_t rays_of_kind);

} // namespace raywise::bench
