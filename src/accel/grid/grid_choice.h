// How fine a grid is made, and whether its cells have the corners of their triangles, by the rays that are expected.
//
// ns per triangle to build and ns a ray (random, one by one, one thread, other work beside it; AMD EPYC with AVX-512, 2026-12-01):
//                                      bunny       igea        dragon      terrain of 2.1 M    soup of 1 M
//     lists, 1/2 cell per triangle     10   600    13   1380   16   1490   16   2500           18    6700
//     lists, 1 cell                    15   560    15   1150   18   1340   19   1950           20    7100
//     corners, 1/4 cell                26   440    25   -      30   660    29   -              109   1830
//     corners, 1/2 cell                30   400    28   600    33   590    33   800            171   2100
//     corners, 1 cell                  36   420    32   570    37   560    43   770            216   2470
// So corners pay from a ray per 10 to 60 triangles on. docs/decisions/0023-grids.md.
#pragma once

#include "accel/accel.h"

#include <array>
#include <cstdint>

namespace raywise {

// Rays per primitive.
inline constexpr double rays_for_gathering = 1.0 / 32.0;
// Cells per primitive.
inline constexpr double density_of_lists = 0.5;
inline constexpr double density_of_blocks = 0.25;

// Whether cells have the corners of their triangles beside each other: where so many rays are expected, and memory allows.
bool gathering_pays(const BuildInput& input);

// References beyond this coarsen the grid: large primitives that overlap each other, for which smaller cells gain little.
inline std::uint64_t max_grid_references(std::uint64_t primitives) { return 24 * primitives + (1u << 16); }

// Cells no narrower than the walk's proof asks for (cell_walk.h): half of overlap_slack of them above what a ray's place is off by. A ray
// from far away is moved next to the scene and rounded there, to 2^-53 of its coordinates and 2^-103 of its distance, which is below 2^60
// sizes of the scene; planes are off by 2^-47 sizes. bounds: of the lattice, within the scene's.
std::array<std::uint32_t, 3> walkable_resolution(std::array<std::uint32_t, 3> resolution, const Box& bounds,
                                                 const Box& scene);

} // namespace raywise
