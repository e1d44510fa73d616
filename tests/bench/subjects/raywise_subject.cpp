#include "bench/subjects/raywise_subject.h"

#include "bench/subjects/frames.h"

#include <utility>
#include <vector>

namespace raywise::bench {
namespace {

std::vector<double> moved(const std::vector<float>& points, const Vec3& offset) {
    std::vector<double> result(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        result[i] = static_cast<double>(points[i]) + offset[static_cast<int>(i % 3)];
    return result;
}

// The single calls of each precision.
struct CallsF32 {
    using Number = float;
    using CallersRay = rw_ray_f32;
    using CallersHit = rw_hit_f32;

    explicit CallsF32(const Library& library)
        : intersect(library.rw_scene_intersect_f32), occluded(library.rw_scene_occluded_f32) {}

    decltype(&::rw_scene_intersect_f32) intersect;
    decltype(&::rw_scene_occluded_f32) occluded;
};

struct CallsF64 {
    using Number = double;
    using CallersRay = rw_ray;
    using CallersHit = rw_hit;

    explicit CallsF64(const Library& library)
        : intersect(library.rw_scene_intersect), occluded(library.rw_scene_occluded) {}

    decltype(&::rw_scene_intersect) intersect;
    decltype(&::rw_scene_occluded) occluded;
};

// Ray by ray.
template <class Calls, Question question>
class SingleQuery : public Query {
public:
    SingleQuery(const Library& library, const rw_scene* scene, const RaySet& rays, const Vec3& offset)
        : calls_(library), scene_(scene) {
        rays_.resize(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double origin = static_cast<double>(rays.origin[3 * i + axis]) + offset[static_cast<int>(axis)];
                rays_[i].origin[axis] = static_cast<typename Calls::Number>(origin);
                rays_[i].direction[axis] = rays.direction[3 * i + axis];
            }
            rays_[i].tmin = rays.tmin[i];
            rays_[i].tmax = rays.tmax[i];
        }
    }

    std::uint64_t ask(std::size_t first, std::size_t last) override {
        std::uint64_t hits = 0;
        for (std::size_t i = first; i < last; ++i) {
            if constexpr (question == Question::any) {
                std::int32_t occluded = 0;
                calls_.occluded(scene_, &rays_[i], nullptr, &occluded);
                hits += occluded != 0 ? 1 : 0;
            } else {
                typename Calls::CallersHit hit;
                calls_.intersect(scene_, &rays_[i], nullptr, &hit);
                hits += hit.primitive != RW_INVALID_ID ? 1 : 0;
            }
        }
        return hits;
    }

private:
    const Calls calls_;
    const rw_scene* scene_;
    std::vector<typename Calls::CallersRay> rays_;
};

class BatchQuery : public Query {
public:
    BatchQuery(const Library& library, const rw_scene* scene, const QueryRequest& request, const Vec3& offset)
        : library_(library),
          scene_(scene),
          rays_(request.rays),
          question_(request.question),
          answers_(request.answers != nullptr ? *request.answers : own_answers_) {
        answers_.make_room(rays_.size(), question_);
        options_.struct_size = sizeof options_;
        options_.threads = request.threads;
        if (offset != Vec3(0.0)) origins_ = moved(rays_.origin, offset);
    }

    std::uint64_t ask(std::size_t first, std::size_t last) override {
        rw_rays rays{};
        rays.struct_size = sizeof rays;
        rays.count = last - first;
        rays.origin.data = &rays_.origin[3 * first];
        if (!origins_.empty()) {
            rays.origin.data = &origins_[3 * first];
            rays.origin.type = RW_FLOAT64;
        }
        rays.direction.data = &rays_.direction[3 * first];
        rays.tmin.data = &rays_.tmin[first];
        rays.tmax.data = &rays_.tmax[first];
        std::uint64_t hits = 0;
        if (question_ == Question::any) {
            rw_output occluded{};
            occluded.data = &answers_.occluded[first];
            library_.check(library_.rw_scene_occluded_batch(scene_, &rays, &occluded, &options_));
            for (std::size_t i = first; i < last; ++i) hits += answers_.occluded[i];
        } else {
            rw_hits results{};
            results.struct_size = sizeof results;
            results.t.data = &answers_.t[first];
            results.uv.data = &answers_.uv[2 * first];
            results.primitive.data = &answers_.primitive[first];
            library_.check(library_.rw_scene_intersect_batch(scene_, &rays, &results, &options_));
            for (std::size_t i = first; i < last; ++i) hits += answers_.primitive[i] != RW_INVALID_ID ? 1 : 0;
        }
        return hits;
    }

private:
    const Library& library_;
    const rw_scene* scene_;
    RaySet rays_;
    std::vector<double> origins_; // of a scene that lies elsewhere, instead of the float32 ones
    Question question_;
    Answers own_answers_;
    Answers& answers_;
    rw_query_options options_{};
};

class RaywiseScene : public Built {
public:
    RaywiseScene(const Library& library, const char* structure, const BuildRequest& request)
        : library_(library), offset_(request.offset), scene_(nullptr, library.rw_scene_release) {
        rw_scene* scene = nullptr;
        library.check(library.rw_scene_create(nullptr, &scene));
        scene_.reset(scene);
        rw_triangles triangles{};
        triangles.struct_size = sizeof triangles;
        triangles.flags = RW_TRIANGLES_SHARED;
        triangles.vertex_count = request.mesh.vertex_count();
        triangles.vertices.data = request.mesh.vertices.data();
        if (offset_ != Vec3(0.0)) {
            vertices_ = moved(request.mesh.vertices, offset_);
            triangles.vertices.data = vertices_.data();
            triangles.vertices.type = RW_FLOAT64;
        }
        triangles.triangle_count = request.mesh.triangle_count();
        triangles.indices.data = request.mesh.indices.data();
        library.check(library.rw_scene_add_triangles(scene, &triangles, nullptr));
        rw_expected_rays expected{};
        expected.struct_size = sizeof expected;
        expected.kind = static_cast<std::int32_t>(request.kind) + RW_RAYS_RANDOM;
        expected.count = request.count;
        library.check(library.rw_scene_set_expected_rays(scene, &expected));
        if (structure != nullptr) library.check(library.rw_scene_set_structure(scene, structure));
        rw_commit_options options{};
        options.struct_size = sizeof options;
        options.threads = request.threads;
        library.check(library.rw_scene_commit(scene, &options));
    }

    std::unique_ptr<Query> query(const QueryRequest& request) const override {
        if (request.call == Call::batch) return std::make_unique<BatchQuery>(library_, scene_.get(), request, offset_);
        // As whoever has such data: float32 where it holds the scene, as peers are asked.
        return offset_ == Vec3(0.0) ? single<CallsF32>(request) : single<CallsF64>(request);
    }

    double bytes() const override {
        const rw_scene_statistics told = statistics();
        return static_cast<double>(told.structure_bytes + told.geometry_bytes);
    }

    std::string structure() const override { return statistics().structure; }

private:
    template <class Calls>
    std::unique_ptr<Query> single(const QueryRequest& request) const {
        if (request.question == Question::any)
            return std::make_unique<SingleQuery<Calls, Question::any>>(library_, scene_.get(), request.rays, offset_);
        return std::make_unique<SingleQuery<Calls, Question::closest>>(library_, scene_.get(), request.rays, offset_);
    }

    rw_scene_statistics statistics() const {
        rw_scene_statistics told{};
        told.struct_size = sizeof told;
        library_.check(library_.rw_scene_get_statistics(scene_.get(), &told));
        return told;
    }

    const Library& library_;
    Vec3 offset_;
    std::vector<double> vertices_; // float64, where the mesh lies elsewhere
    std::unique_ptr<rw_scene, decltype(&::rw_scene_release)> scene_;
};

class Raywise : public Subject {
public:
    Raywise(Traits traits, const Library& library, const char* structure)
        : Subject(std::move(traits)), library_(library), structure_(structure) {}

    std::unique_ptr<Built> build(const BuildRequest& request) const override {
        return std::make_unique<RaywiseScene>(library_, structure_, request);
    }

private:
    const Library& library_;
    const char* structure_;
};

class RaywiseFrames : public Frames {
public:
    RaywiseFrames(const Library& library, const char* structure, Renewal renewal, const workloads::Mesh& mesh)
        : Frames(mesh), library_(library), scene_(nullptr, library.rw_scene_release) {
        options_.struct_size = sizeof options_;
        options_.threads = 1;
        options_.refit = renewal == Renewal::build ? RW_REFIT_NEVER : RW_REFIT_WHERE_POSSIBLE;
        rw_scene* scene = nullptr;
        library.check(library.rw_scene_create(nullptr, &scene));
        scene_.reset(scene);
        const rw_triangles triangles = described();
        library.check(library.rw_scene_add_triangles(scene, &triangles, nullptr));
        library.check(library.rw_scene_set_structure(scene, structure));
        library.check(library.rw_scene_commit(scene, &options_));
    }

    void next() override {
        const rw_triangles triangles = described();
        rw_scene* scene = nullptr;
        library_.check(library_.rw_scene_refit(scene_.get(), &triangles, 1, &options_, &scene));
        scene_.reset(scene);
    }

    std::unique_ptr<Query> query(const QueryRequest& request) const override {
        return std::make_unique<SingleQuery<CallsF32, Question::closest>>(library_, scene_.get(), request.rays,
                                                                          Vec3(0.0));
    }

private:
    rw_triangles described() const {
        rw_triangles triangles{};
        triangles.struct_size = sizeof triangles;
        triangles.flags = RW_TRIANGLES_SHARED;
        triangles.vertex_count = mesh_.vertex_count();
        triangles.vertices.data = mesh_.vertices.data();
        triangles.triangle_count = mesh_.triangle_count();
        triangles.indices.data = mesh_.indices.data();
        return triangles;
    }

    const Library& library_;
    rw_commit_options options_{};
    std::unique_ptr<rw_scene, decltype(&::rw_scene_release)> scene_;
};

} // namespace

std::unique_ptr<Frames> raywise_frames(const Library& library, const char* structure, Renewal renewal,
                                       const workloads::Mesh& mesh) {
    return std::make_unique<RaywiseFrames>(library, structure, renewal, mesh);
}

std::unique_ptr<Subject> raywise_subject(const RaywiseSettings& settings, const Library& library) {
    const char* const structure = settings.structure;
    Traits traits;
    traits.name = settings.name;
    traits.instruction_set = settings.instruction_set;
    traits.peer = false;
    traits.robust = true;
    traits.chooses = structure == nullptr;
    traits.totals = structure == nullptr;
    traits.batches = true;
    traits.calls = {Call::single, Call::batch};
    return std::make_unique<Raywise>(std::move(traits), library, structure);
}

bool has_structure(const Library& library, const std::string& structure) {
    std::uint32_t count = 0;
    library.check(library.rw_structure_count(&count));
    for (std::uint32_t i = 0; i < count; ++i) {
        const char* name = nullptr;
        library.check(library.rw_structure_name(i, &name));
        if (structure == name) return true;
    }
    return false;
}

} // namespace raywise::bench
