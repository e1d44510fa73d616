#include "oracle/scenes.h"

#include "io/mesh_file.h"

#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <utility>

namespace raywise::oracle {
namespace {

double uniform(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

Vec3 point_in_cube(std::mt19937_64& random) {
    const double x = uniform(random, -1.0, 1.0);
    const double y = uniform(random, -1.0, 1.0);
    return {x, y, uniform(random, -1.0, 1.0)};
}

double as_float(double x) { return static_cast<double>(static_cast<float>(x)); }
Vec3 as_float(const Vec3& v) { return {as_float(v.x), as_float(v.y), as_float(v.z)}; }

Scene named(Scene scene, const std::string& name) {
    scene.name = name;
    return scene;
}

} // namespace

Scene single_triangle() { return {"single triangle", {{0, 0, 0}, {1, 0, 0.25}, {0, 1, 0.5}}, {{0, 1, 2}}}; }

Scene tetrahedron() {
    return {"tetrahedron",
            {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
            {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}},
            true};
}

Scene cube() {
    Scene scene{"cube", {}, {}, true};
    for (int i = 0; i < 8; ++i) {
        scene.vertices.emplace_back((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    }
    const std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : faces) {
        scene.triangles.push_back({f[0], f[1], f[2]});
        scene.triangles.push_back({f[0], f[2], f[3]});
    }
    return scene;
}

Scene icosphere(int subdivisions) {
    const double g = (1.0 + std::sqrt(5.0)) / 2.0;
    Scene scene{"icosphere " + std::to_string(subdivisions),
                {{-1, g, 0},
                 {1, g, 0},
                 {-1, -g, 0},
                 {1, -g, 0},
                 {0, -1, g},
                 {0, 1, g},
                 {0, -1, -g},
                 {0, 1, -g},
                 {g, 0, -1},
                 {g, 0, 1},
                 {-g, 0, -1},
                 {-g, 0, 1}},
                {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}},
                true};
    for (int step = 0; step < subdivisions; ++step) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(scene.vertices.size()));
            if (is_new) scene.vertices.push_back(scene.vertices[a] + scene.vertices[b]);
            return found->second;
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto& [a, b, c] : scene.triangles) {
            const std::uint32_t ab = middle(a, b);
            const std::uint32_t bc = middle(b, c);
            const std::uint32_t ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        scene.triangles = std::move(finer);
        for (Vec3& v : scene.vertices) v = v / std::sqrt(glm::dot(v, v));
    }
    for (Vec3& v : scene.vertices) v = as_float(v);
    return scene;
}

Scene terrain(int cells) {
    Scene scene{"terrain " + std::to_string(cells), {}, {}};
    std::mt19937_64 random(7);
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            const double height = std::sin(0.7 * x) * std::cos(0.4 * y) + uniform(random, 0.0, 0.3);
            scene.vertices.push_back(as_float(Vec3(x, y, height)));
        }
    }
    const auto at = [cells](int x, int y) { return static_cast<std::uint32_t>(y * (cells + 1) + x); };
    for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells; ++x) {
            scene.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
            scene.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
        }
    }
    return scene;
}

Scene flat_square(int cells, int axis) {
    Scene scene = terrain(cells);
    scene.name = std::string("flat square across ") + "xyz"[axis];
    for (Vec3& v : scene.vertices) {
        const Vec3 flat(v.x, v.y, 0.0);
        v = {flat[(3 - axis + 2) % 3], flat[(3 - axis) % 3], flat[(3 - axis + 1) % 3]};
    }
    return scene;
}

Scene soup(int triangles, unsigned seed) {
    Scene scene{"soup " + std::to_string(triangles), {}, {}};
    std::mt19937_64 random(seed);
    for (int i = 0; i < triangles; ++i) {
        const double size = std::pow(10.0, uniform(random, -3.0, 0.3));
        const Vec3 center = point_in_cube(random);
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        for (int corner = 0; corner < 3; ++corner) {
            scene.vertices.push_back(as_float(center + size * point_in_cube(random)));
        }
        scene.triangles.push_back({first, first + 1, first + 2});
    }
    return scene;
}

Scene slivers(int triangles, unsigned seed) {
    Scene scene{"slivers", {{0, 0, 0}}, {}};
    std::mt19937_64 random(seed);
    Vec3 direction = point_in_cube(random);
    scene.vertices.push_back(as_float(direction));
    for (int i = 0; i < triangles; ++i) {
        if (i % 16 == 0) direction = point_in_cube(random);
        direction += 1e-6 * point_in_cube(random);
        scene.vertices.push_back(as_float(direction));
        const auto last = static_cast<std::uint32_t>(scene.vertices.size() - 1);
        scene.triangles.push_back({0, last - 1, last});
    }
    return scene;
}

Scene duplicates_and_degenerates() {
    Scene scene{"duplicates and degenerates", {}, {}};
    const Scene base = soup(8, 3);
    scene.vertices = base.vertices;
    scene.vertices.push_back(0.5 * base.vertices[0] + 0.5 * base.vertices[1]); // on an edge
    const auto middle = static_cast<std::uint32_t>(scene.vertices.size() - 1);
    for (const auto& [a, b, c] : base.triangles) {
        scene.triangles.insert(scene.triangles.end(),
                               {{a, b, c}, {a, a, b}, {b, c, a}, {c, c, c}, {c, b, a}, {a, b, c}, {a, b, a}});
    }
    scene.triangles.push_back({0, middle, 1});
    return scene;
}

Scene all_degenerate() {
    return {
        "all degenerate", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 0, 0}}, {{0, 1, 2}, {3, 3, 3}, {0, 3, 0}, {1, 2, 2}}};
}

Scene empty_scene() { return {"empty", {}, {}}; }

Scene stacked_squares(int count) {
    Scene scene{"stacked squares", {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}}, {}};
    for (int i = 0; i < count; ++i) {
        scene.triangles.push_back({0, 1, 2});
        scene.triangles.push_back({0, 2, 3});
    }
    return scene;
}

Scene transformed(Scene scene, double factor, Vec3 offset, bool as_float32) {
    for (Vec3& v : scene.vertices) {
        v = factor * v + offset;
        if (as_float32) v = as_float(v);
    }
    return scene;
}

std::vector<Scene> hard_scenes() {
    std::vector<Scene> scenes = {single_triangle(),
                                 tetrahedron(),
                                 cube(),
                                 icosphere(2),
                                 terrain(8),
                                 soup(150, 1),
                                 slivers(150, 2),
                                 duplicates_and_degenerates(),
                                 all_degenerate(),
                                 empty_scene(),
                                 stacked_squares(6)};
    for (int axis = 0; axis < 3; ++axis) scenes.push_back(flat_square(5, axis));

    const std::pair<const char*, double> factors[] = {{"1e-8", 1e-8},   {"1e8", 1e8},   {"1e-38", 1e-38},
                                                      {"1e-41", 1e-41}, {"1e30", 1e30}, {"1e38", 1e38}};
    for (const auto& [text, factor] : factors) {
        for (const Scene& base : {icosphere(1), soup(60, 4), terrain(4)}) {
            const double largest = base.name == terrain(4).name ? factor / 8 : factor / 2;
            scenes.push_back(named(transformed(base, largest, Vec3(0.0), true), base.name + " times " + text));
        }
    }
    const Vec3 offsets[] = {{1e3, -2e3, 3e3}, {1e6, 1e6, -1e6}, {1e8, 0, 1e8}, {-3e12, 1e12, 5e12}};
    for (const Vec3& offset : offsets) {
        for (const bool as_float32 : {true, false}) {
            const std::string text =
                " at " + std::to_string(static_cast<long long>(offset.x)) + (as_float32 ? ", float32" : "");
            scenes.push_back(named(transformed(icosphere(1), 1.0, offset, as_float32), "icosphere 1" + text));
            scenes.push_back(named(transformed(soup(60, 5), 1.0, offset, as_float32), "soup" + text));
        }
    }
    // A speck far from a giant.
    Scene mixed = named(transformed(icosphere(1), 1e8, Vec3(0.0), true), "speck and giant");
    const Scene speck = transformed(icosphere(1), 1e-8, Vec3(2e8, 0, 0), false);
    const auto first = static_cast<std::uint32_t>(mixed.vertices.size());
    mixed.vertices.insert(mixed.vertices.end(), speck.vertices.begin(), speck.vertices.end());
    for (const auto& [a, b, c] : speck.triangles) mixed.triangles.push_back({first + a, first + b, first + c});
    mixed.closed = false;
    scenes.push_back(std::move(mixed));
    for (Scene& scene : scenes) {
        // Rounded to float32 far away a sphere of size 1 collapses; it is then no longer closed around its middle.
        if (scene.closed && scene.name.find("float32") != std::string::npos) scene.closed = false;
    }
    return scenes;
}

std::vector<Scene> large_scenes() {
    return {icosphere(4),
            terrain(60),
            soup(3000, 6),
            slivers(1500, 8),
            stacked_squares(400),
            flat_square(40, 2),
            named(transformed(soup(2000, 9), 1.0, Vec3(1e6, -1e6, 1e6), false), "soup 2000 at 1e6")};
}

std::filesystem::path data_folder() {
    std::error_code error;
    if (const char* folder = std::getenv("RAYWISE_TEST_DATA")) {
        return std::filesystem::is_directory(folder, error) ? std::filesystem::path(folder) : std::filesystem::path();
    }
    const std::filesystem::path beside =
        std::filesystem::path(RAYWISE_SOURCE_DIR) / ".." / "shared" / "data" / "meshes";
    return std::filesystem::is_directory(beside, error) ? beside : std::filesystem::path();
}

std::vector<Scene> real_meshes(std::size_t most_triangles) {
    std::vector<Scene> scenes;
    const std::filesystem::path folder = data_folder();
    if (folder.empty()) return scenes;
    for (const char* file : {"spot.obj", "suzanne.obj", "teapot.obj", "woody.obj", "cheburashka.obj", "homer.obj",
                             "stanford-bunny.obj", "igea.ply"}) {
        std::error_code error;
        if (!std::filesystem::is_regular_file(folder / file, error)) continue;
        const LoadedMesh mesh = load_mesh(folder / file);
        if (mesh.indices.size() / 3 > most_triangles) continue;
        Scene scene{file, {}, {}};
        for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
            const Vec3 vertex(mesh.coordinate(3 * i), mesh.coordinate(3 * i + 1), mesh.coordinate(3 * i + 2));
            scene.vertices.push_back(as_float(vertex));
        }
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            scene.triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
        }
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

Primitives primitives_of(const Scene& scene) {
    TriangleArrays arrays;
    arrays.vertices = {reinterpret_cast<const std::byte*>(scene.vertices.data()), sizeof(Vec3), sizeof(double),
                       Scalar::float64};
    arrays.vertex_count = scene.vertices.size();
    static const std::byte none{};
    const void* indices = scene.triangles.empty() ? &none : static_cast<const void*>(scene.triangles.data());
    arrays.indices = {static_cast<const std::byte*>(indices), 3 * sizeof(std::uint32_t), sizeof(std::uint32_t),
                      Scalar::uint32};
    arrays.triangle_count = scene.triangles.size();
    return Primitives({std::make_shared<const TriangleMesh>(arrays, true, false)});
}

} // namespace raywise::oracle
