// From the triangles that a ray meets to the crossings of surfaces: the rule for all hits.
#pragma once

#include "geometry/primitives.h"
#include "ray/exact_ray.h"

#include <cstddef>
#include <vector>

namespace raywise {

// Takes out of all hits of a ray, sorted, those that a ray exactly through an edge or a corner meets more than once. They are the
// elements from `first` on.
//
// Triangles include their edges and corners, so that such a ray finds a hit wherever it touches something. But then it meets the
// two triangles of an edge, or all of those around a corner, in one crossing, and counting hits would not tell inside from
// outside. Here the ray counts as one beside it: its origin is moved by an infinitesimal step towards the inside of the first
// hit's triangle, and a far smaller one along x, a far smaller one again along y, then z (a symbolic perturbation; Edelsbrunner
// and Muecke 1990, "Simulation of Simplicity"). That ray passes through no edge or corner at all, its line crosses a closed
// mesh an even number of times, and since it still hits the first triangle the closest hit stays the first of all hits.
//
// The direction is not moved: what is seen edge-on stays without a hit.
void keep_crossings(const ExactRay& ray, const Primitives& primitives, std::vector<PrimitiveHit>& hits,
                    std::size_t first = 0);

} // namespace raywise
