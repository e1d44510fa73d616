// Chords through two random points of the bounding sphere: the first scheme of Hapala, Karlik, Havran 2011.
#include "rays/rays.h"
#include "scenes/random.h"

#include <limits>

namespace raywise::workloads {

Rays random_rays(const RayRequest& request) {
    const Sphere sphere = bounding_sphere(request.mesh);
    Random random(request.seed);
    Rays rays;
    for (std::uint64_t i = 0; i < request.count; ++i) {
        const Vec3 from = sphere.centre + random.on_sphere() * sphere.radius;
        const Vec3 to = sphere.centre + random.on_sphere() * sphere.radius;
        const Vec3 along = to - from;
        // Two equal points are no chord; they are as good as never drawn.
        rays.add(from, along == Vec3(0.0) ? Vec3(0.0, 0.0, sphere.radius) : along, 0.0,
                 std::numeric_limits<double>::infinity());
    }
    return rays;
}

} // namespace raywise::workloads
