#include "scene/scene.h"

#include "model/policy.h"

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
    build(std::nullopt, parallel, progress);
}

std::shared_ptr<Scene> Scene::seen(std::shared_ptr<const Scene> scene, const ViewRequest& request,
                                   const Parallel& parallel, Progress& progress) {
    scene->require_committed();
    if (scene->behind_) scene = scene->behind_;
    auto view = std::make_shared<Scene>(scene->profile_);
    view->meshes_ = scene->meshes_;
    view->triangle_count_ = scene->triangle_count_;
    view->view_ = request;

    PlanRequest plan;
    plan.primitives = scene->tracer_->shared_primitives();
    plan.primitives->settle_areas(parallel);
    plan.profile = scene->profile_;
    plan.workload = request.workload;
    plan.forced = request.forced;
    plan.memory_limit = scene->memory_limit_;
    plan.view = request.frame;
    // A projected structure of the scene's was built without this view and cannot stand in for one that is.
    if (!needs_view(scene->plan_.chosen)) {
        plan.ready = scene->plan_.chosen;
        plan.ready_accel = scene->tracer_->shared_accel();
    }
    view->plan_and_commit(plan, parallel, progress);
    // What has become of the scene's structure goes for the view that uses it.
    if (&view->tracer_->accel() == &scene->tracer_->accel()) view->plan_.refit = scene->plan_.refit;
    view->behind_ = std::move(scene);
    return view;
}

std::shared_ptr<Scene> Scene::refitted(const std::vector<MovedMesh>& meshes, const Parallel& parallel,
                                       Progress& progress) const {
    require_committed();
    if (meshes.size() != meshes_.size()) {
        throw Error(Status::ERROR_INVALID_ARGUMENT, "mesh_count: it is " + std::to_string(meshes.size()) +
                                                        ", the scene has " + std::to_string(meshes_.size()) +
                                                        " meshes");
    }
    if (behind_) return seen(behind_->refitted(meshes, parallel, progress), view_, parallel, progress);
    auto scene = std::make_shared<Scene>(profile_);
    scene->triangle_count_ = triangle_count_;
    scene->workload_ = workload_;
    scene->sample_ = sample_;
    scene->memory_limit_ = memory_limit_;
    scene->forced_ = forced_;
    scene->effort_ = effort_;
    scene->rule_ = rule_;
    scene->time_limit_seconds_ = time_limit_seconds_;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const MovedMesh& mesh = meshes[i];
        const TriangleMesh& before = *meshes_[i];
        if (mesh.arrays.triangle_count != before.triangle_count()) {
            throw Error(Status::ERROR_INVALID_ARGUMENT,
                        mesh.name + "triangle_count: it is " + std::to_string(mesh.arrays.triangle_count) +
                            ", the scene's mesh has " + std::to_string(before.triangle_count()) + " triangles");
        }
        scene->meshes_.push_back(
            std::make_shared<const TriangleMesh>(before, mesh.arrays, mesh.copy, mesh.skip_invalid, mesh.name));
    }
    tracer_->primitives().settle_areas(parallel);
    scene->build(PlanBefore{plan_, tracer_->accel(), tracer_->primitives().hittable_count()}, parallel, progress);
    return scene;
}

void Scene::build(const std::optional<PlanBefore>& before, const Parallel& parallel, Progress& progress) {
    PlanRequest request;
    const bool wait =
        !before && effort_ == Effort::estimate && rule_ == Rule::smallest_total && areas_can_wait(workload_);
    request.primitives = std::make_shared<const Primitives>(meshes_, parallel,
                                                            wait ? AreasAre::settled_on_demand : AreasAre::settled_now);
    request.profile = profile_;
    request.workload = workload_;
    request.sample = sample_;
    request.effort = effort_;
    request.rule = rule_;
    request.time_limit_seconds = time_limit_seconds_;
    request.forced = forced_;
    request.memory_limit = memory_limit_;
    if (before) request.before.emplace(*before);
    plan_and_commit(request, parallel, progress);
}

void Scene::plan_and_commit(const PlanRequest& request, const Parallel& parallel, Progress& progress) {
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
