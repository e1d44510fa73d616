#include "contract/meshes.h"

#include "io/mesh_file.h"
#include "oracle/scenes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raywise::contract {
namespace {

constexpr double huge = std::numeric_limits<double>::max();
constexpr double pi = 3.14159265358979323846;

void add(const oracle::Scene& scene, Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), scene.vertices.begin(), scene.vertices.end());
    for (const auto& [a, b, c] : scene.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

int whole(const MeshStep& step, std::size_t i) { return static_cast<int>(step.numbers[i]); }

// A closed surface of revolution around z: rings of `sectors` vertices between two poles.
struct Ring {
    double radius;
    double z;
};
oracle::Scene revolution(const std::vector<Ring>& rings, double south, double north, int sectors) {
    oracle::Scene scene;
    const auto n = static_cast<std::uint32_t>(sectors);
    for (const Ring& ring : rings) {
        for (int i = 0; i < sectors; ++i) {
            const double angle = 2.0 * pi * i / sectors;
            scene.vertices.emplace_back(ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.z);
        }
    }
    const auto south_pole = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.emplace_back(0.0, 0.0, south);
    scene.vertices.emplace_back(0.0, 0.0, north);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = (i + 1) % n;
        scene.triangles.push_back({south_pole, next, i});
        for (std::uint32_t ring = 0; ring + 1 < rings.size(); ++ring) {
            const std::uint32_t low = ring * n;
            const std::uint32_t high = low + n;
            scene.triangles.push_back({low + i, low + next, high + next});
            scene.triangles.push_back({low + i, high + next, high + i});
        }
        const auto last = static_cast<std::uint32_t>((rings.size() - 1) * n);
        scene.triangles.push_back({south_pole + 1, last + i, last + next});
    }
    return scene;
}

void make_box(const MeshStep& step, Mesh& mesh) {
    oracle::Scene scene = oracle::cube();
    for (Vec3& v : scene.vertices) v *= 0.5 * Vec3(step.numbers[0], step.numbers[1], step.numbers[2]);
    add(scene, mesh);
}

// The cube from -1 to 1 with every face cut into cells * cells squares, vertices shared.
void make_grid_box(const MeshStep& step, Mesh& mesh) {
    const int cells = whole(step, 0);
    oracle::Scene scene;
    const int side = cells + 1;
    std::vector<std::uint32_t> numbers(static_cast<std::size_t>(side * side * side), ~0u);
    const auto at = [&](const std::array<int, 3>& p) {
        std::uint32_t& number = numbers[static_cast<std::size_t>((p[2] * side + p[1]) * side + p[0])];
        if (number == ~0u) {
            number = static_cast<std::uint32_t>(scene.vertices.size());
            const auto coordinate = [cells](int i) { return 2.0 * i / cells - 1.0; };
            scene.vertices.emplace_back(coordinate(p[0]), coordinate(p[1]), coordinate(p[2]));
        }
        return number;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int end : {0, cells}) {
            for (int i = 0; i < cells; ++i) {
                for (int j = 0; j < cells; ++j) {
                    const auto corner = [&](int di, int dj) {
                        std::array<int, 3> p{};
                        p[axis] = end;
                        p[(axis + 1) % 3] = i + di;
                        p[(axis + 2) % 3] = j + dj;
                        return at(p);
                    };
                    std::array<std::uint32_t, 4> square = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
                    if (end == 0) std::swap(square[1], square[3]); // outwards
                    scene.triangles.push_back({square[0], square[1], square[2]});
                    scene.triangles.push_back({square[0], square[2], square[3]});
                }
            }
        }
    }
    add(scene, mesh);
}

void make_uv_sphere(const MeshStep& step, Mesh& mesh) {
    std::vector<Ring> rings;
    const int count = whole(step, 0);
    for (int i = 1; i <= count; ++i) {
        const double angle = pi * i / (count + 1);
        rings.push_back({std::sin(angle), -std::cos(angle)});
    }
    add(revolution(rings, -1.0, 1.0, whole(step, 1)), mesh);
}

void make_cylinder(const MeshStep& step, Mesh& mesh) {
    const double half = 0.5 * step.numbers[1];
    add(revolution({{step.numbers[0], -half}, {step.numbers[0], half}}, -half, half, whole(step, 2)), mesh);
}

void make_torus(const MeshStep& step, Mesh& mesh) {
    const int around = whole(step, 2);
    const int across = whole(step, 3);
    oracle::Scene scene;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double a = 2.0 * pi * i / around;
            const double b = 2.0 * pi * j / across;
            const double distance = step.numbers[0] + step.numbers[1] * std::cos(b);
            scene.vertices.emplace_back(distance * std::cos(a), distance * std::sin(a), step.numbers[1] * std::sin(b));
        }
    }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % around) * across + j % across); };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            scene.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            scene.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    add(scene, mesh);
}

// Squares' worth of slivers side by side: count strips of the given width in x and length 1 in y, each cut by a diagonal.
void make_strips(const MeshStep& step, Mesh& mesh) {
    oracle::Scene scene;
    const int count = whole(step, 0);
    for (int i = 0; i <= count; ++i) {
        scene.vertices.emplace_back(step.numbers[1] * i, 0.0, 0.0);
        scene.vertices.emplace_back(step.numbers[1] * i, 1.0, 0.0);
    }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
        scene.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
        scene.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
    }
    add(scene, mesh);
}

void make_file(const MeshStep& step, Mesh& mesh) {
    const std::filesystem::path folder = oracle::data_folder();
    std::error_code error;
    if (folder.empty() || !std::filesystem::is_regular_file(folder / step.text, error)) {
        throw MeshFileAbsent("the mesh file " + step.text + " is not here");
    }
    const LoadedMesh loaded = load_mesh(folder / step.text);
    oracle::Scene scene;
    for (std::size_t i = 0; i < 3 * loaded.vertex_count(); i += 3) {
        scene.vertices.emplace_back(loaded.coordinate(i), loaded.coordinate(i + 1), loaded.coordinate(i + 2));
    }
    for (std::size_t i = 0; i + 2 < loaded.indices.size(); i += 3) {
        scene.triangles.push_back({loaded.indices[i], loaded.indices[i + 1], loaded.indices[i + 2]});
    }
    add(scene, mesh);
}

double as_float32(double x) {
    // A double beyond float32's range has no float32 to become.
    if (std::isfinite(x) && std::fabs(x) > static_cast<double>(std::numeric_limits<float>::max())) return x;
    return static_cast<double>(static_cast<float>(x));
}

} // namespace

const std::vector<Generator>& generators() {
    using Step = const MeshStep&;
    static const std::vector<Generator> all = {
        {"box", {{"x", 0, huge, false}, {"y", 0, huge, false}, {"z", 0, huge, false}}, false, make_box},
        {"grid-box", {{"cells", 1, 64, true}}, false, make_grid_box},
        {"tetrahedron", {}, false, [](Step, Mesh& mesh) { add(oracle::tetrahedron(), mesh); }},
        {"icosphere",
         {{"subdivisions", 0, 7, true}},
         false,
         [](Step s, Mesh& mesh) { add(oracle::icosphere(whole(s, 0)), mesh); }},
        {"uv-sphere", {{"rings", 1, 1000, true}, {"sectors", 3, 1000, true}}, false, make_uv_sphere},
        {"cylinder",
         {{"radius", 0, huge, false}, {"height", 0, huge, false}, {"sectors", 3, 1000, true}},
         false,
         make_cylinder},
        {"torus",
         {{"radius", 0, huge, false},
          {"thickness", 0, huge, false},
          {"around", 3, 1000, true},
          {"across", 3, 1000, true}},
         false,
         make_torus},
        {"terrain",
         {{"cells", 1, 500, true}},
         false,
         [](Step s, Mesh& mesh) { add(oracle::terrain(whole(s, 0)), mesh); }},
        {"flat",
         {{"axis", 0, 2, true}, {"cells", 1, 500, true}},
         false,
         [](Step s, Mesh& mesh) { add(oracle::flat_square(whole(s, 1), whole(s, 0)), mesh); }},
        {"stack",
         {{"count", 1, 10000, true}},
         false,
         [](Step s, Mesh& mesh) { add(oracle::stacked_squares(whole(s, 0)), mesh); }},
        {"soup",
         {{"triangles", 1, 100000, true}, {"seed", 0, 4294967295.0, true}},
         false,
         [](Step s, Mesh& mesh) { add(oracle::soup(whole(s, 0), static_cast<unsigned>(s.numbers[1])), mesh); }},
        {"slivers",
         {{"triangles", 1, 100000, true}, {"seed", 0, 4294967295.0, true}},
         false,
         [](Step s, Mesh& mesh) { add(oracle::slivers(whole(s, 0), static_cast<unsigned>(s.numbers[1])), mesh); }},
        {"strips", {{"count", 1, 100000, true}, {"width", 0, huge, false}}, false, make_strips},
        {"duplicates", {}, false, [](Step, Mesh& mesh) { add(oracle::duplicates_and_degenerates(), mesh); }},
        {"degenerates", {}, false, [](Step, Mesh& mesh) { add(oracle::all_degenerate(), mesh); }},
        {"file", {}, true, make_file},
    };
    return all;
}

const Generator* generator_named(const std::string& name) {
    const auto& all = generators();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Generator& g) { return g.name == name; });
    return found == all.end() ? nullptr : &*found;
}

const std::vector<Change>& changes() {
    using Numbers = const std::vector<double>&;
    static const std::vector<Change> all = {
        {"scale",
         {{"x", -huge, huge, false}, {"y", -huge, huge, false}, {"z", -huge, huge, false}},
         1,
         [](Numbers n, const Vec3& v) { return v * (n.size() == 1 ? Vec3(n[0]) : Vec3(n[0], n[1], n[2])); }},
        {"move",
         {{"x", -huge, huge, false}, {"y", -huge, huge, false}, {"z", -huge, huge, false}},
         3,
         [](Numbers n, const Vec3& v) { return v + Vec3(n[0], n[1], n[2]); }},
        {"grid",
         {{"step", std::numeric_limits<double>::denorm_min(), huge, false}},
         1,
         [](Numbers n, const Vec3& v) { return n[0] * glm::round(v / n[0]); }},
    };
    return all;
}

const Change* change_named(const std::string& name) {
    const auto& all = changes();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Change& c) { return c.name == name; });
    return found == all.end() ? nullptr : &*found;
}

Mesh make_mesh(const GeometryLines& lines) {
    Mesh mesh;
    mesh.float32 = lines.float32;
    mesh.skip_invalid = lines.skip_invalid;
    std::size_t part = 0; // where the latest "mesh" line began
    for (const MeshStep& step : lines.steps) {
        std::size_t touched = mesh.vertices.size();
        if (step.verb == "v") {
            mesh.vertices.emplace_back(step.numbers[0], step.numbers[1], step.numbers[2]);
        } else if (step.verb == "f") {
            std::array<std::uint32_t, 3> corners{};
            for (std::size_t i = 0; i < 3; ++i) corners[i] = static_cast<std::uint32_t>(step.numbers[i]);
            mesh.triangles.push_back(corners);
        } else if (const Change* change = change_named(step.verb)) {
            touched = part;
            for (std::size_t i = part; i < mesh.vertices.size(); ++i) {
                mesh.vertices[i] = change->apply(step.numbers, mesh.vertices[i]);
            }
        } else {
            part = mesh.vertices.size();
            generator_named(step.verb)->make(step, mesh);
        }
        if (!mesh.float32) continue;
        for (std::size_t i = touched; i < mesh.vertices.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) mesh.vertices[i][axis] = as_float32(mesh.vertices[i][axis]);
        }
    }
    return mesh;
}

} // namespace raywise::contract
