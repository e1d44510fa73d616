// Rays towards one light. They start a little off the surface, as renderers do, and end a little before the light.
#include "rays/rays.h"
#include "rays/visible_points.h"

namespace raywise::workloads {

Rays shadow_rays(const RayRequest& request) {
    const Vec3 light = light_of(request.mesh);
    const VisiblePoints points = visible_points(request);
    Rays rays;
    for (const Vec3& point : points.position) rays.add(point, light - point, 1e-4, 1.0 - 1e-4);
    return rays;
}

} // namespace raywise::workloads
