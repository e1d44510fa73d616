#include "contract/sweep_closed_scenes.h"

#include "base/box.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace raywise::sweep {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::size_t inside_points_wanted = 16;
// The exact check of a larger mesh takes seconds. None of those is convex.
constexpr std::size_t convexity_most_triangles = 30000;

struct Placement {
    const char* name;
    double factor;
    Vec3 offset;
    bool as_float32;
};

// Eastings and northings of UTM are up to 1e6 and 1e7 metres; millimetres there take float64. Powers of two keep every
// difference of coordinates exact, other factors do not.
const Placement placements[] = {
    {"", 1.0, Vec3(0.0), true},
    {" times 2^-66", 0x1p-66, Vec3(0.0), true},
    {" times 2^66", 0x1p66, Vec3(0.0), true},
    {" times 1e-20", 1e-20, Vec3(0.0), true},
    {" times 1e20", 1e20, Vec3(0.0), true},
    {" times 1e-20, float64", 1e-20, Vec3(0.0), false},
    {" times 1e20, float64", 1e20, Vec3(0.0), false},
    {" at UTM coordinates, float64", 0.37, Vec3(491234.567, 5401234.891, 312.345), false},
    {" of millimetres at UTM coordinates, float64", 1e-3, Vec3(5e5, 5e6, 250.0), false},
    {" at 5e6, quarter steps, float64", 4.0, Vec3(5e6, -5e6, 5e6), false},
};

} // namespace

oracle::Scene torus(int around, int across) {
    oracle::Scene scene{"torus", {}, {}, true};
    for (int i = 0; i < around; ++i) {
        const double a = 2.0 * pi * i / around;
        for (int k = 0; k < across; ++k) {
            const double b = 2.0 * pi * k / across;
            const double ring = 1.0 + 0.4 * std::cos(b);
            const Vec3 p(ring * std::cos(a), ring * std::sin(a), 0.4 * std::sin(b));
            scene.vertices.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
        }
    }
    const auto at = [around, across](int i, int k) {
        return static_cast<std::uint32_t>((i % around) * across + k % across);
    };
    for (int i = 0; i < around; ++i) {
        for (int k = 0; k < across; ++k) {
            scene.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
            scene.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
        }
    }
    return scene;
}

oracle::Scene grid_box(int cells) {
    oracle::Scene scene{"grid box", {}, {}, true};
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const auto first = static_cast<std::uint32_t>(scene.vertices.size());
            for (int y = 0; y <= cells; ++y) {
                for (int x = 0; x <= cells; ++x) {
                    Vec3 p;
                    p[axis] = side;
                    p[(axis + 1) % 3] = -1.0 + 2.0 * x / cells;
                    p[(axis + 2) % 3] = -1.0 + 2.0 * y / cells;
                    scene.vertices.push_back(p);
                }
            }
            const auto at = [first, cells](int x, int y) {
                return first + static_cast<std::uint32_t>(y * (cells + 1) + x);
            };
            for (int y = 0; y < cells; ++y) {
                for (int x = 0; x < cells; ++x) {
                    std::array<std::uint32_t, 3> lower{at(x, y), at(x + 1, y), at(x + 1, y + 1)};
                    std::array<std::uint32_t, 3> upper{at(x, y), at(x + 1, y + 1), at(x, y + 1)};
                    if (side < 0.0) {
                        std::swap(lower[1], lower[2]);
                        std::swap(upper[1], upper[2]);
                    }
                    scene.triangles.push_back(lower);
                    scene.triangles.push_back(upper);
                }
            }
        }
    }
    return scene;
}

ClosedScene closed_scene(oracle::Scene mesh) {
    ClosedScene scene;
    scene.mesh = welded(std::move(mesh));
    if (!is_closed(scene.mesh)) throw std::runtime_error(scene.mesh.name + " is not closed");
    scene.float32 = true;
    Box box;
    for (const Vec3& v : scene.mesh.vertices) {
        box.extend(v);
        for (int axis = 0; axis < 3; ++axis)
            scene.float32 = scene.float32 && static_cast<double>(static_cast<float>(v[axis])) == v[axis];
    }
    const Vec3 half = 0.5 * box.size();
    const double largest = max_component(half);
    scene.radius = largest * std::sqrt(glm::dot(half / largest, half / largest));
    scene.convex = scene.mesh.triangles.size() <= convexity_most_triangles && is_convex(scene.mesh);
    scene.edges = edges_of(scene.mesh);
    Random random{scene.mesh.triangles.size(), scene.edges.size()};
    scene.inside = inside_points(scene.mesh, inside_points_wanted, random);
    if (scene.inside.empty()) throw std::runtime_error(scene.mesh.name + " has no inside");
    return scene;
}

std::vector<ClosedScene> closed_scenes(std::uint64_t most_triangles, bool real) {
    std::vector<oracle::Scene> meshes;
    const auto add = [&meshes, most_triangles](oracle::Scene mesh, const std::string& name) {
        if (mesh.triangles.size() > most_triangles) return;
        mesh.name = name;
        meshes.push_back(std::move(mesh));
    };
    add(oracle::tetrahedron(), "tetrahedron");
    for (int subdivisions = 0; subdivisions <= 5; ++subdivisions) {
        const oracle::Scene sphere = oracle::icosphere(subdivisions);
        add(sphere, sphere.name);
    }
    add(torus(96, 48), "torus 9216");
    add(grid_box(16), "grid box 3072");
    for (const Placement& placement : placements) {
        for (const oracle::Scene& mesh : {oracle::cube(), oracle::icosphere(2), grid_box(4), torus(24, 12)}) {
            if (mesh.name == "icosphere 2" && placement.factor == 1.0) continue; // is there already
            add(oracle::transformed(mesh, placement.factor, placement.offset, placement.as_float32),
                mesh.name + placement.name);
        }
    }
    std::vector<ClosedScene> scenes;
    for (oracle::Scene& mesh : meshes) scenes.push_back(closed_scene(std::move(mesh)));
    if (real) {
        for (oracle::Scene& mesh : oracle::real_meshes(most_triangles)) {
            if (is_closed(welded(mesh))) scenes.push_back(closed_scene(std::move(mesh)));
        }
    }
    return scenes;
}

} // namespace raywise::sweep
