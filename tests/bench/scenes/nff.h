// Scenes of Haines's Standard Procedural Databases in NFF (Eric Haines, "A Proposal for Standard Graphics Environments", IEEE
// CG&A 1987), cut into triangles: polygons (concave ones too), spheres, and cones, whose ends are open.
#pragma once

#include "scenes/scenes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::bench {

// With the file's eye and its first light. Throws std::runtime_error that names the line when it cannot be read.
// primitive_of: receives the number of each triangle's primitive in the file.
workloads::Mesh load_nff(const std::string& path, std::vector<std::uint32_t>* primitive_of = nullptr);

} // namespace raywise::bench
