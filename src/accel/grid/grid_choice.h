// How fine a grid is made, and whether its cells have the corners of their triangles, by the rays that are expected.
//
// Random, camera and diffuse rays one by one, one thread: a cell per primitive instead of a half takes 2 to 4 ns per triangle more to
// build and 50 to 190 ns a ray less; gathered corners take 25 to 35 ns per triangle more on meshes, and 200 to 900 ns a ray less (bunny,
// dragon, terrain of 2.1 million triangles). More cells than one per primitive gain nothing once corners are gathered. AMD EPYC
// with AVX-512, 2026-12-01; docs/decisions/0023-grids.md.
#pragma once

#include "accel/accel.h"

#include <array>
#include <cstdint>

namespace raywise {

// Rays per primitive.
inline constexpr double rays_for_more_cells = 1.0 / 32.0;
inline constexpr double rays_for_gathering = 1.0 / 8.0;
// Cells per primitive.
inline constexpr double density_for_few_rays = 0.5;
inline constexpr double density_for_many_rays = 1.0;

// Whether more rays are expected than so many per primitive.
inline bool expects_rays(const BuildInput& input, double per_primitive) {
    if (input.few_rays) return false;
    const auto primitives = static_cast<double>(input.primitives.hittable_count());
    return !input.rays || static_cast<double>(*input.rays) > per_primitive * primitives;
}

// References beyond this coarsen the grid: large primitives that overlap each other, for which smaller cells gain little.
inline std::uint64_t max_grid_references(std::uint64_t primitives) { return 24 * primitives + (1u << 16); }

// Cells no narrower than the walk's proof asks for (cell_walk.h): half of overlap_slack of them above what a ray's place is off by. A ray
// from far away is moved next to the scene and rounded there, to 2^-53 of its coordinates and 2^-103 of its distance, which is below 2^60
// sizes of the scene; planes are off by 2^-47 sizes. bounds: of the lattice, within the scene's.
std::array<std::uint32_t, 3> walkable_resolution(std::array<std::uint32_t, 3> resolution, const Box& bounds,
                                                 const Box& scene);

} // namespace raywise
