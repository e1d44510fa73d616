#include "fuzz/reference.h"

#include "fuzz/failure.h"
#include "fuzz/rays.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>
#include <utility>

namespace raywise::fuzz {
namespace {

rw_scene* make_scene(const Meshes& meshes, const char* structure, bool packed) {
    rw_scene* scene = nullptr;
    demand(rw_scene_create(nullptr, &scene) == RW_OK, "a scene could not be made");
    for (const auto& mesh : meshes) {
        const rw_triangles triangles = packed ? mesh->packed() : mesh->triangles();
        const std::int32_t status = rw_scene_add_triangles(scene, &triangles, nullptr);
        if (status != RW_OK) {
            fail("a mesh that one scene took was refused by another (%s): %s", packed ? "packed" : "as it is",
                 rw_last_error_message());
        }
    }
    demand(rw_scene_set_structure(scene, structure) == RW_OK, "a structure could not be forced");
    const std::int32_t status = rw_scene_commit(scene, nullptr);
    if (status != RW_OK) fail("a scene could not be committed on %s: %s", structure, rw_last_error_message());
    return scene;
}

} // namespace

const std::vector<std::string>& structure_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> found;
        std::uint32_t count = 0;
        demand(rw_structure_count(&count) == RW_OK, "the structures could not be counted");
        for (std::uint32_t i = 0; i < count; ++i) {
            const char* name = nullptr;
            demand(rw_structure_name(i, &name) == RW_OK, "a structure has no name");
            found.emplace_back(name);
        }
        return found;
    }();
    return names;
}

rw_hit miss() {
    rw_hit hit{};
    hit.t = std::numeric_limits<double>::infinity();
    hit.instance = hit.geometry = hit.primitive = RW_INVALID_ID;
    return hit;
}

Reference::Reference(Meshes meshes, bool everywhere) : meshes_(std::move(meshes)) {
    scenes_.push_back(make_scene(meshes_, "linear_scan", true));
    asked_.emplace_back(scenes_.back(), "the judge");
    if (!everywhere) return;
    for (const std::string& name : structure_names()) {
        scenes_.push_back(make_scene(meshes_, name.c_str(), false));
        asked_.emplace_back(scenes_.back(), name);
    }
}

Reference::~Reference() {
    for (const rw_scene* scene : scenes_) rw_scene_release(scene);
}

rw_ray_options options_of(const Skips& skips) {
    rw_ray_options options{};
    options.struct_size = sizeof options;
    options.skip_count = static_cast<std::uint32_t>(skips.size());
    options.skip = skips.data();
    return options;
}

std::vector<rw_hit> Reference::all(const rw_ray& ray, const Skips& skips) const {
    const rw_ray_options options = options_of(skips);
    std::uint64_t needed = 0;
    demand(rw_scene_intersect_all(judge(), &ray, &options, nullptr, 0, &needed) == RW_OK,
           "the judge could not count hits");
    std::vector<rw_hit> hits(needed);
    demand(rw_scene_intersect_all(judge(), &ray, &options, hits.data(), needed, &needed) == RW_OK,
           "the judge could not list hits");
    demand(needed == hits.size(), "the judge counts hits twice in two ways");
    check(ray, skips, hits);
    return hits;
}

rw_hit Reference::closest(const rw_ray& ray, const Skips& skips) const {
    const std::vector<rw_hit> hits = all(ray, skips);
    return hits.empty() ? miss() : hits.front();
}

void Reference::check(const rw_ray& ray, const Skips& skips, const std::vector<rw_hit>& hits) const {
    constexpr double weight_error = 0x1p-29; // the header promises 2^-30 for u and v each
    const auto complain = [&](const rw_hit& hit, const char* what) {
        describe(ray);
        fail("linear_scan: %s; t %a, u %a, v %a, geometry %u, primitive %u", what, hit.t, hit.u, hit.v, hit.geometry,
             hit.primitive);
    };
    const auto key = [](const rw_hit& hit) { return std::make_tuple(hit.t, hit.geometry, hit.primitive); };
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const rw_hit& hit = hits[i];
        if (i > 0 && !(key(hits[i - 1]) < key(hit))) {
            for (const rw_hit& each : hits) {
                std::fprintf(stderr, "  hit t %a, geometry %u, primitive %u\n", each.t, each.geometry, each.primitive);
            }
            complain(hit, "hits are not in order");
        }
        if (!(hit.t >= ray.tmin && hit.t <= ray.tmax) || std::isinf(hit.t))
            complain(hit, "a hit outside the ray's interval");
        if (!(hit.u >= -weight_error && hit.v >= -weight_error && hit.u + hit.v <= 1.0 + weight_error)) {
            complain(hit, "a hit outside its triangle");
        }
        if (hit.instance != RW_INVALID_ID || hit.reserved != 0) complain(hit, "an instance or reserved bits in a hit");
        if (hit.geometry >= meshes_.size() || hit.primitive >= meshes_[hit.geometry]->triangle_count()) {
            complain(hit, "a hit of a triangle that is not there");
        }
        double n[3];
        demand(rw_scene_normal(judge(), &hit, n) == RW_OK, "a hit without a normal");
        if (!(std::fabs(std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) - 1.0) < 1e-12))
            complain(hit, "a normal that is not of length 1");
        const bool skipped = std::any_of(skips.begin(), skips.end(), [&](const rw_primitive_id& id) {
            return id.geometry == hit.geometry && id.primitive == hit.primitive;
        });
        if (skipped) complain(hit, "a hit of a triangle that is skipped");
        if (meshes_[hit.geometry]->is_invalid(hit.primitive))
            complain(hit, "a hit of a triangle with an invalid corner");
    }
}

} // namespace raywise::fuzz
