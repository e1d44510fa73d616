// STL files. OpenMesh's reader merges corners that are near each other and drops facets, so these few lines are our
// own.
#pragma once

#include "io/mesh_file.h"

#include <string_view>

namespace raywise::io {

// Three vertices for each facet. Binary when the size fits the count of facets (whatever the first word says),
// otherwise ASCII.
LoadedMesh read_stl(std::string_view bytes);

} // namespace raywise::io
