// Rays that leave surfaces as light does from chalk: by the cosine to the normal.
#include "rays/rays.h"
#include "rays/visible_points.h"
#include "scenes/random.h"
#include "scenes/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raywise::workloads {

Rays diffuse_rays(const RayRequest& request) {
    const double scale = bounding_sphere(request.mesh).radius;
    const VisiblePoints points = visible_points(request);
    Random random(request.seed);
    Rays rays;
    for (std::size_t i = 0; i < points.position.size(); ++i) {
        // A point of the disc, lifted onto the hemisphere, is cosine-weighted (Malley).
        const Vec2 disc = random.in_disc();
        const double height = std::sqrt(std::max(0.0, 1.0 - disc.x * disc.x - disc.y * disc.y));
        const Vec3 along = Frame(points.normal[i]) * Vec3(disc, height);
        rays.add(points.position[i], along, 1e-5 * scale, std::numeric_limits<double>::infinity());
    }
    return rays;
}

} // namespace raywise::workloads
