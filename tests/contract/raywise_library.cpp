#include "contract/raywise_library.h"

#include "raywise/raywise.h"

#include <array>
#include <cstring>
#include <map>
#include <utility>

namespace raywise::contract {
namespace {

void check(std::int32_t status, const char* call) {
    if (status == RW_OK) return;
    throw std::runtime_error(std::string(call) + ": " + rw_status_text(status) + " (" + rw_last_error_message() + ")");
}

struct Release {
    void operator()(rw_scene* scene) const { rw_scene_release(scene); }
};
using SceneHandle = std::unique_ptr<rw_scene, Release>;

rw_ray to_c(const Ray& ray) {
    return {{ray.origin.x, ray.origin.y, ray.origin.z},
            ray.tmin,
            {ray.direction.x, ray.direction.y, ray.direction.z},
            ray.tmax};
}

Answer from_c(const rw_hit& hit) {
    return {hit.primitive != RW_INVALID_ID, hit.t, hit.u, hit.v, hit.geometry, hit.primitive};
}

void add_mesh(rw_scene* scene, const Mesh& mesh) {
    std::vector<float> floats;
    rw_triangles triangles{};
    triangles.struct_size = sizeof triangles;
    triangles.flags = mesh.skip_invalid ? RW_TRIANGLES_SKIP_INVALID : 0u;
    triangles.vertex_count = mesh.vertices.size();
    if (mesh.float32) {
        for (const Vec3& v : mesh.vertices) {
            for (int axis = 0; axis < 3; ++axis) floats.push_back(static_cast<float>(v[axis]));
        }
        triangles.vertices.data = floats.data();
        triangles.vertices.type = RW_FLOAT32;
    } else {
        triangles.vertices.data = mesh.vertices.data();
        triangles.vertices.stride = sizeof(Vec3);
        triangles.vertices.type = RW_FLOAT64;
    }
    static const std::array<std::uint32_t, 3> none{};
    triangles.triangle_count = mesh.triangles.size();
    triangles.indices.data = mesh.triangles.empty() ? &none : mesh.triangles.data();
    const std::int32_t status = rw_scene_add_triangles(scene, &triangles, nullptr);
    switch (status) {
        case RW_ERROR_NOT_FINITE:
            throw Refusal("not-finite", rw_last_error_message());
        case RW_ERROR_COORDINATE_RANGE:
            throw Refusal("coordinate-range", rw_last_error_message());
        case RW_ERROR_INDEX_OUT_OF_RANGE:
            throw Refusal("index-range", rw_last_error_message());
        default:
            check(status, "rw_scene_add_triangles");
    }
}

SceneHandle commit(const std::vector<Mesh>& meshes, const char* structure) {
    rw_scene* created = nullptr;
    check(rw_scene_create(nullptr, &created), "rw_scene_create");
    SceneHandle scene(created);
    for (const Mesh& mesh : meshes) add_mesh(scene.get(), mesh);
    check(rw_scene_set_structure(scene.get(), structure), "rw_scene_set_structure");
    check(rw_scene_commit(scene.get(), nullptr), "rw_scene_commit");
    return scene;
}

struct Questions {
    using Handle = const rw_scene*;

    static Answer closest(Handle handle, const Ray& ray) {
        const rw_ray asked = to_c(ray);
        rw_hit hit{};
        check(rw_scene_intersect(handle, &asked, nullptr, &hit), "intersect");
        return from_c(hit);
    }
    static bool any(Handle handle, const Ray& ray) {
        const rw_ray asked = to_c(ray);
        std::int32_t occluded = 0;
        check(rw_scene_occluded(handle, &asked, nullptr, &occluded), "occluded");
        return occluded != 0;
    }
    static std::vector<Answer> all(Handle handle, const Ray& ray) {
        const rw_ray asked = to_c(ray);
        std::uint64_t needed = 0;
        check(rw_scene_intersect_all(handle, &asked, nullptr, nullptr, 0, &needed), "intersect_all");
        std::vector<rw_hit> hits(needed);
        if (needed > 0)
            check(rw_scene_intersect_all(handle, &asked, nullptr, hits.data(), needed, &needed), "intersect_all");
        std::vector<Answer> answers;
        for (const rw_hit& hit : hits) answers.push_back(from_c(hit));
        return answers;
    }
    static std::vector<Answer> closest_batch(Handle handle, const std::vector<Ray>& rays) {
        std::vector<rw_ray> asked;
        for (const Ray& ray : rays) asked.push_back(to_c(ray));
        std::vector<rw_hit> answers(rays.size());
        if (rays.empty()) return {};
        rw_rays in{};
        in.struct_size = sizeof in;
        in.count = rays.size();
        in.origin.data = asked[0].origin;
        in.direction.data = asked[0].direction;
        in.tmin.data = &asked[0].tmin;
        in.tmax.data = &asked[0].tmax;
        for (rw_array* array : {&in.origin, &in.direction, &in.tmin, &in.tmax}) {
            array->stride = sizeof(rw_ray);
            array->type = RW_FLOAT64;
        }
        rw_hits out{};
        out.struct_size = sizeof out;
        out.t.data = &answers[0].t;
        out.uv.data = &answers[0].u;
        out.t.type = out.uv.type = RW_FLOAT64;
        out.geometry.data = &answers[0].geometry;
        out.primitive.data = &answers[0].primitive;
        out.geometry.type = out.primitive.type = RW_UINT32;
        for (rw_output* output : {&out.t, &out.uv, &out.geometry, &out.primitive}) output->stride = sizeof(rw_hit);
        check(rw_scene_intersect_batch(handle, &in, &out, nullptr), "intersect_batch");
        std::vector<Answer> converted;
        for (const rw_hit& hit : answers) converted.push_back(from_c(hit));
        return converted;
    }
};

class StructureScene : public Scene {
public:
    explicit StructureScene(SceneHandle scene) : scene_(std::move(scene)) {}
    Answer closest(const Ray& ray) override { return Ask::closest(scene_.get(), ray); }
    bool any(const Ray& ray) override { return Ask::any(scene_.get(), ray); }
    void all(const Ray& ray, std::vector<Answer>& answers) override { answers = Ask::all(scene_.get(), ray); }
    void closest_batch(const std::vector<Ray>& rays, std::vector<Answer>& answers) override {
        answers = Ask::closest_batch(scene_.get(), rays);
    }

private:
    using Ask = Questions;
    SceneHandle scene_;
};

bool same(bool a, bool b) { return a == b; }
bool same(const Answer& a, const Answer& b) {
    if (!a.hit || !b.hit) return a.hit == b.hit;
    return std::memcmp(&a.t, &b.t, sizeof a.t) == 0 && std::memcmp(&a.u, &b.u, sizeof a.u) == 0 &&
           std::memcmp(&a.v, &b.v, sizeof a.v) == 0 && a.geometry == b.geometry && a.primitive == b.primitive;
}
bool same(const std::vector<Answer>& a, const std::vector<Answer>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!same(a[i], b[i])) return false;
    }
    return true;
}

// Asks every ray of a view from its origin and of a view along its direction, and insists that both say the same bits. Only
// so many views are made; later rays ask views that were made for others, which has to make no difference.
class ViewScene : public Scene {
    using Ask = Questions;
    static constexpr std::size_t most_views = 12;

    template <class Question>
    auto both(const Ray& ray, Question&& question) {
        auto from_point = question(view(RW_VIEW_POINT, ray.origin));
        if (!same(from_point, question(view(RW_VIEW_DIRECTION, ray.direction))))
            throw std::runtime_error("a view from the ray's origin and one along its direction differ");
        return from_point;
    }

    const rw_scene* view(std::int32_t kind, Vec3 place) {
        const bool usable = is_finite(place) && (kind == RW_VIEW_POINT || place != Vec3(0.0));
        auto& views = views_[kind];
        if (!usable) place = Vec3(0.0, 0.0, 1.0);
        const std::array<double, 3> key = {place.x, place.y, place.z};
        auto found = views.find(key);
        if (found != views.end()) return found->second.get();
        if (views.size() >= most_views) return views.begin()->second.get();
        rw_view_options options{};
        options.struct_size = sizeof options;
        options.kind = kind;
        options.count = 1000000;
        options.structure = structure_;
        double* const target = kind == RW_VIEW_POINT ? options.origin : options.direction;
        for (int axis = 0; axis < 3; ++axis) target[axis] = place[axis];
        rw_scene* created = nullptr;
        check(rw_scene_view(scene_.get(), &options, nullptr, &created), "rw_scene_view");
        return views.emplace(key, SceneHandle(created)).first->second.get();
    }

public:
    ViewScene(SceneHandle scene, const char* structure) : scene_(std::move(scene)), structure_(structure) {}

    Answer closest(const Ray& ray) override {
        return both(ray, [&](const rw_scene* view) { return Ask::closest(view, ray); });
    }
    bool any(const Ray& ray) override {
        return both(ray, [&](const rw_scene* view) { return Ask::any(view, ray); });
    }
    void all(const Ray& ray, std::vector<Answer>& answers) override {
        answers = both(ray, [&](const rw_scene* view) { return Ask::all(view, ray); });
    }
    void closest_batch(const std::vector<Ray>& rays, std::vector<Answer>& answers) override {
        answers = both(rays.empty() ? Ray{} : rays.front(),
                       [&](const rw_scene* view) { return Ask::closest_batch(view, rays); });
    }

private:
    SceneHandle scene_;
    const char* structure_;
    std::map<std::int32_t, std::map<std::array<double, 3>, SceneHandle>> views_; // released before the scene
};

// What the header promises.
Capabilities promised() {
    Capabilities capabilities;
    capabilities.has_batch = true;
    capabilities.refuses_bad_meshes = true;
    capabilities.t_tolerance = 0x1p-37;
    return capabilities;
}

class StructureLibrary : public Library {
public:
    explicit StructureLibrary(const char* structure) : structure_(structure) {}
    std::string name() const override { return std::string("raywise ") + structure_; }
    Capabilities capabilities() const override { return promised(); }
    std::unique_ptr<Scene> build(const std::vector<Mesh>& meshes) override {
        return std::make_unique<StructureScene>(commit(meshes, structure_));
    }

private:
    const char* structure_; // a constant of the library's
};

class ViewLibrary : public Library {
public:
    std::string name() const override { return "raywise view"; }
    Capabilities capabilities() const override { return promised(); }
    std::unique_ptr<Scene> build(const std::vector<Mesh>& meshes) override {
        return std::make_unique<ViewScene>(commit(meshes, "bvh"), "projected_bvh");
    }
};

} // namespace

std::vector<std::unique_ptr<Library>> raywise_libraries() {
    std::vector<std::unique_ptr<Library>> libraries;
    std::uint32_t count = 0;
    check(rw_structure_count(&count), "rw_structure_count");
    for (std::uint32_t i = 0; i < count; ++i) {
        const char* name = nullptr;
        check(rw_structure_name(i, &name), "rw_structure_name");
        libraries.push_back(std::make_unique<StructureLibrary>(name));
    }
    libraries.push_back(std::make_unique<ViewLibrary>());
    return libraries;
}

} // namespace raywise::contract
