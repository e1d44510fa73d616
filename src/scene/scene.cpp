#include "scene/scene.h"

#include <string>
#include <utility>

namespace raywise {

void Scene::require_uncommitted() const {
    if (is_committed())
        throw Error(Status::ERROR_ALREADY_COMMITTED, "scene: it is committed and cannot be changed any more");
}

void Scene::require_committed() const {
    if (!is_committed()) throw Error(Status::ERROR_NOT_COMMITTED, "scene: it has not been committed yet");
}

std::uint32_t Scene::add_triangles(const TriangleArrays& arrays, bool copy, bool skip_invalid) {
    require_uncommitted();
    const std::uint64_t count = arrays.triangle_count;
    // A mesh that is too large by itself says so itself.
    if (count < PrimitiveHit::no_primitive && triangle_count_ + count >= PrimitiveHit::no_primitive) {
        throw Error(Status::ERROR_TOO_MANY, "triangle_count: the scene would have " +
                                                std::to_string(triangle_count_ + count) +
                                                " triangles, 4294967294 are the most");
    }
    auto mesh = std::make_shared<const TriangleMesh>(arrays, copy, skip_invalid);
    meshes_.push_back(std::move(mesh));
    triangle_count_ += count;
    return static_cast<std::uint32_t>(meshes_.size() - 1);
}

void Scene::set_expected(const Workload& workload, std::vector<Ray> sample) {
    require_uncommitted();
    workload_ = workload;
    sample_ = std::move(sample);
}

void Scene::set_memory_limit(std::uint64_t bytes) {
    require_uncommitted();
    memory_limit_ = bytes;
}

void Scene::set_structure(std::optional<Structure> structure) {
    require_uncommitted();
    forced_ = structure;
}

void Scene::set_effort(Effort effort, Rule rule, double time_limit_seconds) {
    require_uncommitted();
    effort_ = effort;
    rule_ = rule;
    time_limit_seconds_ = time_limit_seconds;
}

void Scene::commit(const Parallel& parallel, Progress& progress) {
    require_uncommitted();
    PlanRequest request;
    request.primitives = std::make_shared<const Primitives>(meshes_, parallel);
    request.profile = profile_;
    request.workload = workload_;
    request.sample = sample_;
    request.effort = effort_;
    request.rule = rule_;
    request.time_limit_seconds = time_limit_seconds_;
    request.forced = forced_;
    request.memory_limit = memory_limit_;
    PlannedAccel planned = plan_and_build(request, parallel, progress);

    // Nothing below can fail half-way: the scene changes with the last line or not at all.
    auto tracer = std::make_unique<const Tracer>(request.primitives, std::move(planned.accel));
    plan_ = std::move(planned.plan);
    tracer_ = std::move(tracer);
}

const Tracer& Scene::tracer() const {
    require_committed();
    return *tracer_;
}

const Plan& Scene::plan() const {
    require_committed();
    return plan_;
}

std::uint64_t Scene::geometry_bytes() const {
    std::uint64_t bytes = 0;
    for (const auto& mesh : meshes_) bytes += mesh->bytes();
    return bytes;
}

} // namespace raywise
