#include "cases.h"

#include "oracle/rays.h"

#include <cmath>

namespace raywise::parity {
namespace {

using oracle::Scene;

// Rays of many sorts, hard ones among them.
std::vector<Ray> usual_rays(const Scene& mesh) {
    std::vector<Ray> rays = oracle::random_rays(mesh, 10, 62);
    int left = 26;
    for (const Ray& ray : oracle::hard_rays(mesh, 2, 63)) {
        if (std::isfinite(ray.tmin) && left-- > 0) rays.push_back(ray);
    }
    // Along each axis through the middle of the first triangle, missing, behind, and of no length at all.
    const auto& t = mesh.triangles.front();
    const Vec3 middle = 0.5 * mesh.vertices[t[0]] + 0.25 * mesh.vertices[t[1]] + 0.25 * mesh.vertices[t[2]];
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 direction(0.0);
        direction[axis] = -2.0;
        rays.push_back({middle - 3.0 * direction, 0.0, direction, INFINITY});
        rays.push_back({middle - 3.0 * direction, 0.0, direction, 0.5});
    }
    rays.push_back({middle, 0.0, Vec3(0.0), INFINITY});
    return rays;
}

// Exactly through corners and edges, where several triangles are met in one crossing: from outside, from there, along
// an edge, and from corner to corner. The steps are whole multiples of a power of two, so that most meshes need no
// rounding.
std::vector<Ray> seam_rays(const Scene& mesh) {
    std::vector<Ray> rays;
    for (const std::size_t triangle : {std::size_t{0}, mesh.triangles.size() / 2}) {
        const auto& t = mesh.triangles[triangle];
        const Vec3 corner = mesh.vertices[t[0]];
        const Vec3 along = mesh.vertices[t[1]] - corner;
        const Vec3 opposite = mesh.vertices[mesh.triangles[mesh.triangles.size() - 1 - triangle][0]];
        const double unit = std::ldexp(1.0, std::ilogb(max_component(glm::abs(along))) - 2);
        for (const Vec3& target : {corner, corner + 0.5 * along}) {
            for (const Vec3& step : {Vec3(3.0, 5.0, 7.0), Vec3(-6.0, 7.0, 1.0), Vec3(0.0, 0.0, 8.0)}) {
                const Vec3 origin = target + unit * step;
                rays.push_back({origin, 0.0, target - origin, INFINITY});
            }
            rays.push_back({target, 0.0, Vec3(-3.0, -5.0, -7.0), INFINITY});
        }
        rays.push_back({corner - along, 0.0, along, INFINITY});
        if (opposite != corner) rays.push_back({corner - (opposite - corner), 0.0, opposite - corner, INFINITY});
    }
    return rays;
}

rw_primitive_id id_of(const rw_hit& hit) { return {hit.instance, hit.geometry, hit.primitive}; }

// The closest hit; the second one; the last and the closest, among repeats and an entry for nothing; all.
std::vector<std::vector<rw_primitive_id>> skip_lists(const std::vector<rw_hit>& hits) {
    std::vector<std::vector<rw_primitive_id>> lists;
    if (hits.empty()) return lists;
    lists.push_back({id_of(hits.front())});
    if (hits.size() == 1) return lists;
    const rw_primitive_id nothing = {RW_INVALID_ID, RW_INVALID_ID, RW_INVALID_ID};
    lists.push_back({id_of(hits[1])});
    lists.push_back({id_of(hits.back()), nothing, id_of(hits.front()), id_of(hits.back())});
    lists.emplace_back();
    for (const rw_hit& hit : hits) lists.back().push_back(id_of(hit));
    return lists;
}

} // namespace

std::vector<Scene> meshes() {
    std::vector<Scene> all = {oracle::tetrahedron(),
                              oracle::cube(),
                              oracle::icosphere(1),
                              oracle::soup(60, 61),
                              oracle::duplicates_and_degenerates(),
                              oracle::transformed(oracle::icosphere(0), 1.0 / 3.0, Vec3(1e6 + 0.1, -2e6, 3e6), false)};
    const char* names[] = {"tetrahedron",        "cube", "icosphere", "soup", "duplicates and degenerates",
                           "far away in float64"};
    for (std::size_t i = 0; i < all.size(); ++i) all[i].name = names[i];
    return all;
}

std::vector<Case> cases(const Scene& mesh, const std::function<std::vector<rw_hit>(const Case&)>& all) {
    std::vector<Case> chosen;
    for (const Ray& ray : usual_rays(mesh)) chosen.push_back({ray, {}});
    for (const Ray& ray : seam_rays(mesh)) chosen.push_back({ray, {}});
    // Every third ray again, with what it hits.
    const std::size_t without = chosen.size();
    for (std::size_t i = 0; i < without; i += 3) {
        for (auto& skip : skip_lists(all(chosen[i]))) chosen.push_back({chosen[i].ray, std::move(skip)});
    }
    return chosen;
}

} // namespace raywise::parity
