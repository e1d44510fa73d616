#include "contract/sweep_closed.h"

#include "base/box.h"
#include "oracle/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace raywise::sweep {
namespace {

constexpr double pi = 3.14159265358979323846;

// Six times the volume of the tetrahedron, exactly: positive where d lies on the side the triangle faces.
int side_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    using oracle::exact;
    using oracle::Fraction;
    const auto from_a = [&a](const Vec3& p) {
        return std::array<Fraction, 3>{exact(p.x) - exact(a.x), exact(p.y) - exact(a.y), exact(p.z) - exact(a.z)};
    };
    const auto e = from_a(b);
    const auto f = from_a(c);
    const auto g = from_a(d);
    const Fraction volume =
        g[0] * (e[1] * f[2] - e[2] * f[1]) + g[1] * (e[2] * f[0] - e[0] * f[2]) + g[2] * (e[0] * f[1] - e[1] * f[0]);
    return volume.sign();
}

// The solid angle of a triangle seen from the origin (van Oosterom, Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double la = std::sqrt(glm::dot(a, a));
    const double lb = std::sqrt(glm::dot(b, b));
    const double lc = std::sqrt(glm::dot(c, c));
    const double volume = glm::dot(a, glm::cross(b, c));
    const double rest = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return 2.0 * std::atan2(volume, rest);
}

Box box_of(const oracle::Scene& mesh) {
    Box box;
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) box.extend(mesh.vertices[corner]);
    }
    return box;
}

} // namespace

oracle::Scene welded(oracle::Scene mesh) {
    std::map<std::tuple<double, double, double>, std::uint32_t> known; // -0 and 0 compare equal, as they should
    std::vector<Vec3> vertices;
    std::vector<std::uint32_t> moved;
    moved.reserve(mesh.vertices.size());
    for (const Vec3& v : mesh.vertices) {
        const auto [place, is_new] =
            known.try_emplace(std::make_tuple(v.x, v.y, v.z), static_cast<std::uint32_t>(vertices.size()));
        if (is_new) vertices.push_back(v);
        moved.push_back(place->second);
    }
    for (auto& triangle : mesh.triangles) {
        for (std::uint32_t& corner : triangle) corner = moved[corner];
    }
    mesh.vertices = std::move(vertices);
    return mesh;
}

std::vector<Edge> edges_of(const oracle::Scene& mesh) {
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (t[k] != t[(k + 1) % 3]) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

bool is_closed(const oracle::Scene& mesh) {
    if (mesh.triangles.empty()) return false;
    std::map<Edge, int> balance;
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k];
            const std::uint32_t b = t[(k + 1) % 3];
            if (a != b) balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    return std::all_of(balance.begin(), balance.end(), [](const auto& entry) { return entry.second == 0; });
}

bool is_convex(const oracle::Scene& mesh) {
    std::map<Edge, std::vector<std::uint32_t>> triangles_at; // by directed edge
    std::set<std::uint32_t> used;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& t = mesh.triangles[i];
        for (std::size_t k = 0; k < 3; ++k) {
            used.insert(t[k]);
            triangles_at[{t[k], t[(k + 1) % 3]}].push_back(i);
        }
    }
    // V - E + F = 2; each edge is there in both directions.
    if (used.size() + mesh.triangles.size() != 2 + triangles_at.size() / 2) return false;
    bool above = false;
    bool below = false;
    for (const auto& [edge, here] : triangles_at) {
        const auto across = triangles_at.find({edge.second, edge.first});
        if (here.size() != 1 || across == triangles_at.end() || across->second.size() != 1) return false;
        const auto& t = mesh.triangles[here.front()];
        for (const std::uint32_t corner : mesh.triangles[across->second.front()]) {
            if (corner == edge.first || corner == edge.second) continue;
            const int side =
                side_of(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[corner]);
            above = above || side > 0;
            below = below || side < 0;
        }
        if (above && below) return false; // only one of them, as the triangles may face inwards
    }
    return true;
}

double winding_number(const oracle::Scene& mesh, const Vec3& point) {
    const Box box = box_of(mesh);
    // Relative to the size of the mesh: products of three lengths are to be normal numbers.
    const double scale = 1.0 / max_component(box.size());
    double sum = 0.0;
    for (const auto& t : mesh.triangles) {
        sum += solid_angle(scale * (mesh.vertices[t[0]] - point), scale * (mesh.vertices[t[1]] - point),
                           scale * (mesh.vertices[t[2]] - point));
    }
    return sum / (4.0 * pi);
}

std::vector<InsidePoint> inside_points(const oracle::Scene& mesh, std::size_t wanted, Random& random) {
    constexpr int attempts_per_point = 40; // a thin mesh fills little of its box
    constexpr double certain = 1e-6;
    std::vector<InsidePoint> points;
    const Box box = box_of(mesh);
    const Vec3 half = 0.5 * box.size();
    for (std::size_t i = 0; i < attempts_per_point * wanted && points.size() < wanted; ++i) {
        const Vec3 point = i == 0 ? box.center() : box.center() + half * random.in_cube();
        const double winding = winding_number(mesh, point);
        const double nearest = std::round(winding);
        if (std::fabs(winding - nearest) > certain || nearest == 0.0) continue;
        points.push_back({point, std::fmod(std::fabs(nearest), 2.0) == 1.0});
    }
    return points;
}

} // namespace raywise::sweep
