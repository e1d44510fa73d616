// Writes cases.json: meshes, rays, what they skip, and the library's answers. Every language that binds it has to agree
// bit for bit.
//
//   parity_generate FILE            writes it
//   parity_generate --compare FILE  tells whether it is what would be written
#include "cases.h"

#include <algorithm>
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

using raywise::Vec3;
using raywise::oracle::Scene;
using raywise::parity::Case;

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

// All hits of a case. The other questions are asked as well, and have to agree.
std::vector<rw_hit> answer(const rw_scene* scene, const Case& c) {
    const raywise::Ray& r = c.ray;
    const rw_ray ray = {
        {r.origin.x, r.origin.y, r.origin.z}, r.tmin, {r.direction.x, r.direction.y, r.direction.z}, r.tmax};
    const rw_ray_options options = {sizeof options, static_cast<std::uint32_t>(c.skip.size()), c.skip.data()};
    std::vector<rw_hit> hits(1000);
    std::uint64_t needed = 0;
    check(rw_scene_intersect_all(scene, &ray, &options, hits.data(), hits.size(), &needed));
    hits.resize(needed);

    rw_hit closest;
    std::int32_t occluded = 0;
    check(rw_scene_intersect(scene, &ray, &options, &closest));
    check(rw_scene_occluded(scene, &ray, &options, &occluded));
    const bool agreed =
        hits.empty() ? closest.primitive == RW_INVALID_ID : std::memcmp(&closest, hits.data(), sizeof closest) == 0;
    if (!agreed || (occluded != 0) == hits.empty()) throw std::runtime_error("closest, any and all hits disagree");
    return hits;
}

std::string skip_text(const std::vector<rw_primitive_id>& skip) {
    std::string text = "[";
    for (const rw_primitive_id& id : skip) {
        text +=
            (text.size() == 1 ? "[" : ",[") + std::to_string(id.geometry) + "," + std::to_string(id.primitive) + "]";
    }
    return text + "]";
}

std::string hit_text(const rw_scene* scene, const rw_hit& hit) {
    double normal[3];
    check(rw_scene_normal(scene, &hit, normal));
    return "{\"t\":" + bits(hit.t) + ",\"u\":" + bits(hit.u) + ",\"v\":" + bits(hit.v) + ",\"normal\":[" +
           bits(normal[0]) + "," + bits(normal[1]) + "," + bits(normal[2]) +
           "],\"geometry\":" + std::to_string(hit.geometry) + ",\"primitive\":" + std::to_string(hit.primitive) + "}";
}

std::string case_text(const rw_scene* scene, const Scene& mesh, const Case& c, const std::vector<rw_hit>& hits) {
    std::string text = "{\"mesh\":\"" + mesh.name + "\",\"origin\":" + numbers(c.ray.origin) +
                       ",\"direction\":" + numbers(c.ray.direction) + ",\"tmin\":" + number(c.ray.tmin) +
                       ",\"tmax\":" + (std::isinf(c.ray.tmax) ? "\"inf\"" : number(c.ray.tmax)) +
                       ",\"skip\":" + skip_text(c.skip) + ",\"hits\":[";
    for (std::size_t i = 0; i < hits.size(); ++i) text += (i == 0 ? "" : ",") + hit_text(scene, hits[i]);
    return text + "]}";
}

std::string generate() {
    std::string mesh_list;
    std::string case_list;
    for (const Scene& mesh : raywise::parity::meshes()) {
        mesh_list += (mesh_list.empty() ? "" : ",\n") + mesh_text(mesh);
        rw_scene* scene = commit(mesh);
        const auto all = [&](const Case& c) { return answer(scene, c); };
        for (const Case& c : raywise::parity::cases(mesh, all))
            case_list += (case_list.empty() ? "" : ",\n") + case_text(scene, mesh, c, all(c));
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
