// Writes cases.json: meshes, rays and the library's answers. Every language that binds it has to agree bit for bit.
//
//   parity_generate FILE            writes it
//   parity_generate --compare FILE  tells whether it is what would be written
#include "oracle/rays.h"
#include "oracle/scenes.h"
#include "raywise/raywise.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using raywise::Ray;
using raywise::Vec3;
using raywise::oracle::Scene;

void check(std::int32_t status) {
    if (status != RW_OK) throw std::runtime_error(rw_last_error_message());
}

// Enough digits to come back as the same number.
std::string number(double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", x);
    return text;
}
std::string numbers(const Vec3& v) { return "[" + number(v.x) + "," + number(v.y) + "," + number(v.z) + "]"; }

std::string bits(double x) {
    std::uint64_t value = 0;
    std::memcpy(&value, &x, sizeof value);
    char text[24];
    std::snprintf(text, sizeof text, "\"0x%016llx\"", static_cast<unsigned long long>(value));
    return text;
}

std::vector<Scene> meshes() {
    namespace o = raywise::oracle;
    std::vector<Scene> all = {o::tetrahedron(),
                              o::cube(),
                              o::icosphere(1),
                              o::soup(60, 61),
                              o::duplicates_and_degenerates(),
                              o::transformed(o::icosphere(0), 1.0 / 3.0, Vec3(1e6 + 0.1, -2e6, 3e6), false)};
    const char* names[] = {"tetrahedron",        "cube", "icosphere", "soup", "duplicates and degenerates",
                           "far away in float64"};
    for (std::size_t i = 0; i < all.size(); ++i) all[i].name = names[i];
    return all;
}

std::vector<Ray> rays(const Scene& scene) {
    std::vector<Ray> chosen = raywise::oracle::random_rays(scene, 10, 62);
    int left = 26;
    for (const Ray& ray : raywise::oracle::hard_rays(scene, 2, 63)) {
        if (std::isfinite(ray.tmin) && left-- > 0) chosen.push_back(ray);
    }
    // Along each axis through the middle of the first triangle, missing, behind, and of no length at all.
    const auto& t = scene.triangles.front();
    const Vec3 middle = 0.5 * scene.vertices[t[0]] + 0.25 * scene.vertices[t[1]] + 0.25 * scene.vertices[t[2]];
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 direction(0.0);
        direction[axis] = -2.0;
        chosen.push_back({middle - 3.0 * direction, 0.0, direction, INFINITY});
        chosen.push_back({middle - 3.0 * direction, 0.0, direction, 0.5});
    }
    chosen.push_back({middle, 0.0, Vec3(0.0), INFINITY});
    return chosen;
}

rw_scene* commit(const Scene& mesh) {
    rw_scene* scene = nullptr;
    rw_triangles triangles{};
    triangles.struct_size = sizeof triangles;
    triangles.vertex_count = mesh.vertices.size();
    triangles.vertices.data = mesh.vertices.data();
    triangles.vertices.type = RW_FLOAT64;
    triangles.triangle_count = mesh.triangles.size();
    triangles.indices.data = mesh.triangles.data();
    check(rw_scene_create(nullptr, &scene));
    check(rw_scene_add_triangles(scene, &triangles, nullptr));
    check(rw_scene_set_structure(scene, "linear_scan"));
    check(rw_scene_commit(scene, nullptr));
    return scene;
}

std::string mesh_text(const Scene& mesh) {
    std::string text = "{\"name\":\"" + mesh.name + "\",\n \"vertices\":[";
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) text += (i == 0 ? "" : ",") + numbers(mesh.vertices[i]);
    text += "],\n \"triangles\":[";
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        text += (i == 0 ? "[" : ",[") + std::to_string(a) + "," + std::to_string(b) + "," + std::to_string(c) + "]";
    }
    return text + "]}";
}

std::string case_text(const Scene& mesh, const rw_scene* scene, const Ray& ray) {
    const rw_ray asked = {{ray.origin.x, ray.origin.y, ray.origin.z},
                          ray.tmin,
                          {ray.direction.x, ray.direction.y, ray.direction.z},
                          ray.tmax};
    rw_hit hit;
    check(rw_scene_intersect(scene, &asked, &hit));
    std::string text = "{\"mesh\":\"" + mesh.name + "\",\"origin\":" + numbers(ray.origin) +
                       ",\"direction\":" + numbers(ray.direction) + ",\"tmin\":" + number(ray.tmin) +
                       ",\"tmax\":" + (std::isinf(ray.tmax) ? "\"inf\"" : number(ray.tmax)) + ",\"hit\":";
    if (hit.primitive == RW_INVALID_ID) return text + "null}";
    return text + "{\"t\":" + bits(hit.t) + ",\"u\":" + bits(hit.u) + ",\"v\":" + bits(hit.v) + ",\"normal\":[" +
           bits(hit.normal[0]) + "," + bits(hit.normal[1]) + "," + bits(hit.normal[2]) +
           "],\"geometry\":" + std::to_string(hit.geometry) + ",\"primitive\":" + std::to_string(hit.primitive) + "}}";
}

std::string generate() {
    std::string mesh_list;
    std::string case_list;
    for (const Scene& mesh : meshes()) {
        mesh_list += (mesh_list.empty() ? "" : ",\n") + mesh_text(mesh);
        rw_scene* scene = commit(mesh);
        for (const Ray& ray : rays(mesh)) case_list += (case_list.empty() ? "" : ",\n") + case_text(mesh, scene, ray);
        check(rw_scene_release(scene));
    }
    return "{\"meshes\":[\n" + mesh_list + "\n],\"cases\":[\n" + case_list + "\n]}\n";
}

int compare(const std::string& text, const char* path) {
    std::ifstream file(path, std::ios::binary);
    const std::string stored{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (stored == text) return 0;
    std::size_t line = 1;
    for (std::size_t i = 0; i < std::min(stored.size(), text.size()) && stored[i] == text[i]; ++i)
        line += text[i] == '\n' ? 1 : 0;
    std::cerr << path << " differs from what the library answers, first in line " << line
              << "; if the new answers are right: parity_generate " << path << "\n";
    return 1;
}

} // namespace

int main(int count, char** arguments) {
    try {
        const std::string text = generate();
        if (count == 3 && std::strcmp(arguments[1], "--compare") == 0) return compare(text, arguments[2]);
        if (count != 2) throw std::runtime_error("parity_generate [--compare] FILE");
        std::ofstream file(arguments[1], std::ios::binary);
        file << text;
        return file.flush() ? 0 : 1;
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
