// Scenes in which something lies far away, compared with what rays are about: a library whose error bounds grow with the scene answers
// right and is thousands of times slower there.
#pragma once

#include "bench/scenes/bench_scenes.h"

namespace raywise::bench {

// The mesh on a square so many times its size. Rays are about the mesh.
TestScene far_ground(workloads::Mesh mesh, double times);

// A height field 150 m wide at UTM coordinates, in float64, and one triangle with a corner at (0, 0, 0), as a vertex that was never
// set leaves it. Peers get the same triangles around (0, 0, 0), where float32 holds them exactly.
TestScene at_utm(workloads::Mesh terrain);

// The mesh, two units wide, and rays that start in the sun, in metres.
TestScene in_far_sun(workloads::Mesh mesh);

} // namespace raywise::bench
