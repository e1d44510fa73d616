// Scenes with something far away: error bounds and slack that grow with the scene would drown what is small in it.
#include "oracle/scenes.h"

#include <cmath>

namespace raywise::oracle {
namespace {

Scene named(Scene scene, const std::string& name) {
    scene.name = name;
    return scene;
}

// Both in one mesh.
void append(Scene& scene, const Scene& other) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.triangles) scene.triangles.push_back({first + a, first + b, first + c});
    scene.closed = false;
}

Scene square(double half, double height) {
    return {"square",
            {{-half, -half, height}, {half, -half, height}, {half, half, height}, {-half, half, height}},
            {{0, 1, 2}, {0, 2, 3}}};
}

Scene far_ground(const Scene& base, double half) {
    Scene scene = named(base, base.name + " on far ground");
    append(scene, square(half, -1.0));
    return scene;
}

// Terrain of 150 m at UTM coordinates, and a triangle with a corner at the origin of the coordinates.
Scene utm() {
    constexpr int cells = 24;
    const Vec3 corner(528980.25, 5183526.5, 112.125);
    Scene scene = named(transformed(terrain(cells), 150.0 / cells, corner, false), "utm");
    append(scene, {"stray", {{0, 0, 0}, corner + Vec3(20, 14, 6), corner + Vec3(21, 14, 6)}, {{0, 1, 2}}});
    return scene;
}

Scene clusters(double distance) {
    Scene scene = icosphere(2);
    append(scene, transformed(soup(200, 61), 1e-9 * distance, Vec3(distance, 0.25 * distance, 0), false));
    return named(scene, "clusters " + std::to_string(std::ilogb(distance)) + " powers of two apart");
}

// Triangles of a millionth of the line's length, one after the other along an axis.
Scene line_of_small_triangles(int count, int axis) {
    Scene scene{std::string("line along ") + "xyz" [axis], {}, {}};
    for (int i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        const double along = static_cast<double>(i) / count;
        for (const Vec3& offset : {Vec3(-1e-6, -1e-6, 0), Vec3(1e-6, -1e-6, 1e-6), Vec3(0, 1e-6, -1e-6)}) {
            Vec3 corner = offset;
            corner[axis] += along;
            scene.vertices.push_back(corner);
        }
        scene.triangles.push_back({first, first + 1, first + 2});
    }
    return scene;
}

// Squares one above the other, so close that each box lies within the slack of the next for a ray from far away.
Scene parallel_sheets(int count, double distance) {
    Scene scene{"parallel sheets", {}, {}};
    for (int i = 0; i < count; ++i) append(scene, square(1.0, i * distance));
    return scene;
}

// Nearly all of it in one place far from the origin, and from the middle of the box.
Scene far_median(double place) {
    Scene scene = transformed(icosphere(3), 1.0, Vec3(place, -place, place), false);
    append(scene, single_triangle());
    return named(scene, "median far from the origin");
}

} // namespace

std::vector<Scene> far_scenes() {
    std::vector<Scene> scenes = {far_ground(icosphere(2), 1e5),
                                 far_ground(soup(200, 62), 0x1p40),
                                 utm(),
                                 clusters(1e6),
                                 clusters(1e15),
                                 clusters(1e30),
                                 parallel_sheets(300, 0x1p-20),
                                 parallel_sheets(300, 0x1p-50),
                                 far_median(1e6),
                                 far_median(1e12)};
    for (int axis = 0; axis < 3; ++axis) scenes.push_back(line_of_small_triangles(400, axis));
    return scenes;
}

} // namespace raywise::oracle
