// Procedural scenes for calibration, tests and benchmarks. The same arguments give the same bits on every platform: own
// random numbers, and only arithmetic that IEEE 754 rounds in one way.
#pragma once

#include "base/box.h"
#include "base/vec.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace raywise::workloads {

// Where a pinhole camera stands.
struct Camera {
    Vec3 eye;
    Vec3 target;
    double vertical_angle; // radians, from the lower to the upper edge of the image
};

struct Mesh {
    std::vector<float> vertices;        // x y z of each
    std::vector<std::uint32_t> indices; // three per triangle
    std::optional<Camera> camera;       // scenes one is inside of; empty: from outside, framing all
    std::optional<Vec3> light;          // empty: above the scene

    std::uint64_t vertex_count() const { return vertices.size() / 3; }
    std::uint64_t triangle_count() const { return indices.size() / 3; }
    Box bounds() const;
};

struct Scene {
    const char* name;
    const char* description;
    // triangles: how many are wanted; the scene has about as many, but no fewer than its shape needs.
    Mesh (*make)(std::uint64_t triangles, std::uint64_t seed);
};

// All of scene_list.def, in its order.
const std::vector<Scene>& scenes();

// nullptr when no scene has that name.
const Scene* scene_named(const char* name);

} // namespace raywise::workloads
