#include "scene/view.h"

#include <utility>

namespace raywise {

View::View(std::shared_ptr<const Scene> scene, const ViewRequest& request, const Parallel& parallel, Progress& progress)
    : scene_(std::move(scene)) {
    PlanRequest plan;
    plan.primitives = scene_->tracer().shared_primitives();
    plan.profile = scene_->profile();
    plan.workload = request.workload;
    plan.forced = request.forced;
    plan.memory_limit = scene_->memory_limit();
    plan.view = request.frame;
    // A projected structure of the scene's was built without this view and cannot stand in for one that is.
    if (!needs_view(scene_->plan().chosen)) {
        plan.ready = scene_->plan().chosen;
        plan.ready_accel = scene_->tracer().shared_accel();
    }
    PlannedAccel planned = plan_and_build(plan, parallel, progress);
    plan_ = std::move(planned.plan);
    tracer_ = std::make_unique<const Tracer>(plan.primitives, std::move(planned.accel));
}

} // namespace raywise
