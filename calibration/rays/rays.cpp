#include "rays/rays.h"

#include <algorithm>
#include <cmath>

namespace raywise::workloads {

const std::vector<RayDistribution>& ray_distributions() {
    static const std::vector<RayDistribution> all = {
        {"random", false, random_rays},
        {"camera", false, camera_rays},
        {"shadow", true, shadow_rays},
        {"diffuse", false, diffuse_rays},
    };
    return all;
}

void Rays::add(const Vec3& from, const Vec3& along, double first, double last) {
    for (int axis = 0; axis < 3; ++axis) origin.push_back(from[axis]);
    for (int axis = 0; axis < 3; ++axis) direction.push_back(along[axis]);
    tmin.push_back(first);
    tmax.push_back(last);
}

Sphere bounding_sphere(const Mesh& mesh) {
    const Box box = mesh.bounds();
    const Vec3 half = 0.5 * box.size();
    return {box.center(), std::max(std::sqrt(glm::dot(half, half)), 1e-30)};
}

Camera camera_of(const Mesh& mesh) {
    if (mesh.camera) return *mesh.camera;
    const Sphere sphere = bounding_sphere(mesh);
    const double angle = 0.7; // 40 degrees
    // From the front, the side and above, where the sphere just fills the image: sin(0.35) = 0.343.
    const Vec3 from(0.48, -0.72, 0.5012983136); // unit length
    return {sphere.centre + from * (sphere.radius / 0.343), sphere.centre, angle};
}

Vec3 light_of(const Mesh& mesh) {
    if (mesh.light) return *mesh.light;
    const Sphere sphere = bounding_sphere(mesh);
    return sphere.centre + Vec3(0.6, -0.5, 1.4) * sphere.radius;
}

} // namespace raywise::workloads
