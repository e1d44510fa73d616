// Scenes for the judge: procedural ones, hard ones, and real meshes where the data folder is present.
#pragma once

#include "base/vec.h"
#include "geometry/primitives.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace raywise::oracle {

struct Scene {
    std::string name;
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    bool closed = false; // without a hole, around the mean of its vertices
};

Scene single_triangle();
Scene tetrahedron();
Scene cube();
Scene icosphere(int subdivisions);
// A height field over a square, (cells + 1)^2 vertices.
Scene terrain(int cells);
// A square in the plane z = 0 (axis 2) and so on, cells * cells * 2 triangles.
Scene flat_square(int cells, int axis);
// Unconnected triangles of very different sizes.
Scene soup(int triangles, unsigned seed);
// Needles a millionth as wide as long, fanned around shared corners.
Scene slivers(int triangles, unsigned seed);
// Each of a few triangles several times, its corners rotated and reversed, between degenerate ones.
Scene duplicates_and_degenerates();
Scene all_degenerate();
Scene empty_scene();
// Coplanar squares on top of each other, all hit at the same t.
Scene stacked_squares(int count);

// The same shape elsewhere: factor first, then offset, each vertex rounded to float32 when `as_float32`.
Scene transformed(Scene scene, double factor, Vec3 offset, bool as_float32);

// All of the above, at sizes that suit a test of every ray against every triangle, and at all hard scales.
std::vector<Scene> hard_scenes();
// Larger scenes, for comparing structures with each other.
std::vector<Scene> large_scenes();

// Scenes that are far larger, or farther away, than most of what is in them.
std::vector<Scene> far_scenes();

// The folder named by RAYWISE_TEST_DATA, or shared/data/meshes beside the repository; empty when there is none.
std::filesystem::path data_folder();
// The real meshes found there, at most so large.
std::vector<Scene> real_meshes(std::size_t most_triangles);

// The scene as the library holds it: float64 vertices, copied.
Primitives primitives_of(const Scene& scene);

} // namespace raywise::oracle
