// Scenes that only the benchmark has.
#pragma once

#include "scenes/scenes.h"

namespace raywise::bench {

// A mesh on the floor of a hall so many times its size; the floor is laid out in 20,000 triangles.
workloads::Mesh in_a_hall(workloads::Mesh mesh, double times);

// Long thin triangles in all directions, as long as a fifth of the cube they fill, however many they are: each box overlaps
// thousands of others.
workloads::Mesh long_sticks(std::uint64_t triangles);

} // namespace raywise::bench
