// Ray distributions for calibration, tests and benchmarks, the same on every platform; deterministic as scenes are.
#pragma once

#include "base/vec.h"
#include "scenes/scenes.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace raywise::workloads {

// Structure of arrays, packed: three values per ray in origin and direction, one in tmin and tmax.
struct Rays {
    std::vector<double> origin;
    std::vector<double> direction;
    std::vector<double> tmin;
    std::vector<double> tmax;

    std::uint64_t size() const { return tmin.size(); }
    void add(const Vec3& from, const Vec3& along, double first, double last);
    Vec3 origin_of(std::uint64_t i) const { return {origin[3 * i], origin[3 * i + 1], origin[3 * i + 2]}; }
    Vec3 direction_of(std::uint64_t i) const { return {direction[3 * i], direction[3 * i + 1], direction[3 * i + 2]}; }
};

// The closest hit of a ray; t is infinite for a miss.
struct SurfacePoint {
    double t;
    Vec3 normal; // unit length, of either side
};

// Answers rays for the distributions that start on surfaces; whoever asks for rays brings a tracer along.
using ClosestHits = std::function<std::vector<SurfacePoint>(const Rays& rays)>;

struct RayRequest {
    const Mesh& mesh;
    std::uint64_t count; // how many; fewer only when nothing is in view
    std::uint64_t seed;
    ClosestHits closest; // may be empty for random and camera
};

struct RayDistribution {
    const char* name;
    bool any_hit; // asked whether there is a hit at all, and not for the closest
    Rays (*make)(const RayRequest& request);
};

// random, camera, shadow, diffuse: the order of RW_RAYS_.
const std::vector<RayDistribution>& ray_distributions();

// From a random point of the bounding sphere to another.
Rays random_rays(const RayRequest& request);
// From a pinhole, in the order of an image of 4 to 3.
Rays camera_rays(const RayRequest& request);
// From what the camera sees to the light; the light is at t = 1.
Rays shadow_rays(const RayRequest& request);
// From what the camera sees in all directions, by the cosine to the normal; directions have unit length.
Rays diffuse_rays(const RayRequest& request);

// The mesh's own camera and light, or the usual ones.
Camera camera_of(const Mesh& mesh);
Vec3 light_of(const Mesh& mesh);

// The bounding sphere: around the middle of the box.
struct Sphere {
    Vec3 centre;
    double radius;
};
Sphere bounding_sphere(const Mesh& mesh);

} // namespace raywise::workloads
