#include "measure/library.h"

#include "base/structure.h"
#include "model/cost_units.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>

namespace raywise::calibration {
namespace {

// A zeroed struct that carries its size, as every struct of the interface wants.
template <class T>
T sized() {
    T value{};
    value.struct_size = sizeof(T);
    return value;
}

rw_array doubles(const std::vector<double>& values, std::int64_t components, std::uint64_t step) {
    rw_array array{};
    array.data = values.data();
    array.type = RW_FLOAT64;
    array.stride = static_cast<std::int64_t>(sizeof(double)) * components * static_cast<std::int64_t>(step);
    return array;
}

rw_rays rays_of(const RaySelection& selection) {
    rw_rays rays = sized<rw_rays>();
    rays.count = selection.count;
    rays.origin = doubles(selection.rays.origin, 3, selection.step);
    rays.direction = doubles(selection.rays.direction, 3, selection.step);
    rays.tmin = doubles(selection.rays.tmin, 1, selection.step);
    rays.tmax = doubles(selection.rays.tmax, 1, selection.step);
    return rays;
}

rw_output output_to(void* data, std::int32_t type) {
    rw_output output{};
    output.data = data;
    output.type = type;
    return output;
}

rw_triangles triangles_of(const workloads::Mesh& mesh) {
    rw_triangles triangles = sized<rw_triangles>();
    triangles.flags = RW_TRIANGLES_SHARED;
    triangles.vertex_count = mesh.vertex_count();
    triangles.vertices.data = mesh.vertices.data();
    triangles.vertices.type = RW_FLOAT32;
    triangles.triangle_count = mesh.triangle_count();
    triangles.indices.data = mesh.indices.data();
    triangles.indices.type = RW_UINT32;
    return triangles;
}

// What a grid is made like depends on how many rays are coming (accel/grid/grid_choice.h). Where many are, it loses to trees in any case; so
// what is measured is the form for few of them.
void expect_rays_of(rw_scene* scene, const char* structure, std::uint64_t triangles) {
    constexpr std::uint64_t triangles_per_ray = 64;
    for (const Structure each : all_structures()) {
        if (!differs_by_rays(each) || std::strcmp(structure, name_of(each)) != 0) continue;
        rw_expected_rays expected = sized<rw_expected_rays>();
        expected.kind = RW_RAYS_ANY_KIND;
        expected.count = std::max<std::uint64_t>(triangles / triangles_per_ray, 8);
        check(rw_scene_set_expected_rays(scene, &expected), "rw_scene_set_expected_rays");
    }
}

SceneFeatures features_of(const rw_scene* scene) {
    std::uint64_t size = 0;
    check(rw_scene_explain(scene, RW_FORMAT_JSON, nullptr, 0, &size), "rw_scene_explain");
    std::string text(size, '\0');
    check(rw_scene_explain(scene, RW_FORMAT_JSON, text.data(), size, &size), "rw_scene_explain");
    const nlohmann::json seen = nlohmann::json::parse(text.c_str()).at("features");
    SceneFeatures features;
    for (const SceneFeature& feature : scene_features) features.*feature.value = seen.at(feature.name);
    return features;
}

} // namespace

void check(std::int32_t status, const char* function) {
    if (status == RW_OK) return;
    const char* message = rw_last_error_message();
    throw LibraryError(std::string(function) + ": " + (*message != '\0' ? message : rw_status_text(status)));
}

void check_structures() {
    std::uint32_t count = 0;
    check(rw_structure_count(&count), "rw_structure_count");
    bool same = count == structure_count;
    for (std::uint32_t i = 0; same && i < count; ++i) {
        const char* name = nullptr;
        check(rw_structure_name(i, &name), "rw_structure_name");
        same = std::strcmp(name, structure_names[i]) == 0;
    }
    if (!same)
        throw LibraryError("libraywise has other structures than this program was built for; install them together");
}

Handle<rw_profile> builtin_profile() {
    // The only way the interface has; nothing else in this process reads the variable at the same time.
    ::setenv("RAYWISE_CALIBRATION", "builtin", 1);
    rw_profile* profile = nullptr;
    check(rw_profile_load(nullptr, &profile), "rw_profile_load");
    return Handle<rw_profile>(profile);
}

void Built::ask(const RaySelection& selection, bool any_hit, std::uint32_t threads) {
    rw_query_options options = sized<rw_query_options>();
    options.threads = threads;
    const rw_rays rays = rays_of(selection);
    if (any_hit) {
        occluded_.resize(selection.count);
        const rw_output output = output_to(occluded_.data(), RW_UINT8);
        check(rw_scene_occluded_batch(scene_.get(), &rays, &output, &options), "rw_scene_occluded_batch");
        return;
    }
    t_.resize(selection.count);
    primitive_.resize(selection.count);
    rw_hits hits = sized<rw_hits>();
    hits.t = output_to(t_.data(), RW_FLOAT32);
    hits.primitive = output_to(primitive_.data(), RW_UINT32);
    check(rw_scene_intersect_batch(scene_.get(), &rays, &hits, &options), "rw_scene_intersect_batch");
}

std::vector<workloads::SurfacePoint> Built::closest(const workloads::Rays& rays, std::uint32_t threads) {
    rw_query_options options = sized<rw_query_options>();
    options.threads = threads;
    std::vector<double> t(rays.size()), normal(rays.size() * 3);
    rw_hits hits = sized<rw_hits>();
    hits.t = output_to(t.data(), RW_FLOAT64);
    hits.normal = output_to(normal.data(), RW_FLOAT64);
    const rw_rays all = rays_of({rays, rays.size()});
    check(rw_scene_intersect_batch(scene_.get(), &all, &hits, &options), "rw_scene_intersect_batch");
    std::vector<workloads::SurfacePoint> points;
    for (std::size_t i = 0; i < t.size(); ++i) {
        points.push_back({t[i], Vec3(normal[3 * i], normal[3 * i + 1], normal[3 * i + 2])});
    }
    return points;
}

BuiltScene::BuiltScene(const workloads::Mesh& mesh, const char* structure, const rw_profile* profile,
                       std::uint32_t threads) {
    rw_scene* scene = nullptr;
    check(rw_scene_create(profile, &scene), "rw_scene_create");
    scene_.reset(scene);
    const rw_triangles triangles = triangles_of(mesh);
    check(rw_scene_add_triangles(scene, &triangles, nullptr), "rw_scene_add_triangles");
    check(rw_scene_set_structure(scene, structure), "rw_scene_set_structure");
    expect_rays_of(scene, structure, mesh.triangle_count());
    rw_commit_options options = sized<rw_commit_options>();
    options.threads = threads;
    check(rw_scene_commit(scene, &options), "rw_scene_commit");

    rw_scene_statistics statistics = sized<rw_scene_statistics>();
    check(rw_scene_get_statistics(scene, &statistics), "rw_scene_get_statistics");
    build_ns_ = statistics.build_ns;
    bytes_ = static_cast<double>(statistics.structure_bytes);
    features_ = features_of(scene);
}

BuiltView::BuiltView(const BuiltScene& scene, const ViewPlace& place, const char* structure, std::uint32_t threads) {
    rw_view_options options = sized<rw_view_options>();
    options.kind = RW_VIEW_POINT;
    for (int axis = 0; axis < 3; ++axis) {
        options.origin[axis] = place.origin[axis];
        options.direction[axis] = place.direction[axis];
    }
    options.half_angle = place.half_angle;
    options.count = RW_RAYS_UNKNOWN;
    options.ray_kind = place.ray_kind;
    options.structure = structure;
    rw_commit_options commit = sized<rw_commit_options>();
    commit.threads = threads;
    rw_scene* view = nullptr;
    check(rw_scene_view(scene.handle(), &options, &commit, &view), "rw_scene_view");
    scene_.reset(view);

    features_ = scene.features();
    std::uint32_t count = 0;
    check(rw_scene_candidate_count(view, &count), "rw_scene_candidate_count");
    for (std::uint32_t i = 0; i < count; ++i) {
        rw_candidate candidate = sized<rw_candidate>();
        check(rw_scene_get_candidate(view, i, &candidate), "rw_scene_get_candidate");
        if (std::strcmp(candidate.structure, structure) != 0) continue;
        build_ns_ = candidate.actual_build_ns;
        bytes_ = static_cast<double>(candidate.actual_bytes);
    }
}

} // namespace raywise::calibration
