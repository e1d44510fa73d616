// Where rays meet a mesh, for the kinds of rays that start on surfaces.
#pragma once

#include "bench/subjects/subject.h"
#include "rays/rays.h"

#include <vector>

namespace raywise::bench {

// By a batch call. built: of that mesh.
std::vector<workloads::SurfacePoint> surface_points(const workloads::Mesh& mesh, const Built& built,
                                                    const workloads::Rays& rays, unsigned threads);

} // namespace raywise::bench
