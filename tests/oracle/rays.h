// Rays for the judge: ordinary ones, and those that are known to go wrong elsewhere.
#pragma once

#include "oracle/scenes.h"
#include "ray/ray.h"

#include <vector>

namespace raywise::oracle {

// Chords through two random points around the scene.
std::vector<Ray> random_rays(const Scene& scene, int count, unsigned seed);

// At most about `count` of each sort: along axes and in axis planes; exactly through vertices, points of edges and of
// triangles; from vertices and surfaces; in the plane of a triangle and along its edges; with limited intervals; with
// directions of extreme length; from far away.
std::vector<Ray> hard_rays(const Scene& scene, int count, unsigned seed);

// From so many times the scene's size away, through vertices, points of edges and of triangles, and past them; along axes, too.
std::vector<Ray> rays_from_afar(const Scene& scene, double times, int count, unsigned seed);

// From close to vertices, within a few edges' lengths: of a scene whose box says nothing about where its triangles are.
std::vector<Ray> rays_from_close_by(const Scene& scene, int count, unsigned seed);

// From the middle of a closed scene, exactly through vertices and edges and close by: each has to hit.
std::vector<Ray> leak_rays(const Scene& scene, int count, unsigned seed);

} // namespace raywise::oracle
