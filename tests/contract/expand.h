// A case as a library is asked it: meshes and rays in full.
#pragma once

#include "contract/case_file.h"
#include "contract/library.h"

#include <cstdint>
#include <vector>

namespace raywise::contract {

struct RayGroup {
    const RayLines* lines;
    std::vector<Ray> rays;
};

struct ExpandedCase {
    const Case* source;
    std::vector<Mesh> meshes;
    std::vector<RayGroup> groups;
};

// sweep_factor multiplies the counts of sweeps. Throws MeshFileAbsent.
ExpandedCase expand(const Case& source, std::uint64_t sweep_factor);

} // namespace raywise::contract
