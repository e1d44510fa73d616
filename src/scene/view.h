// A scene seen from a point or along a direction: the same geometry with a structure chosen for rays of that view.
#pragma once

#include "scene/scene.h"

#include <memory>
#include <optional>

namespace raywise {

struct ViewRequest {
    ViewFrame frame;
    Workload workload;
    std::optional<Structure> forced;
};

class View {
public:
    // The scene has to be committed and is kept. The scene's own structure is a candidate that costs nothing to build; the
    // scene's memory limit holds for the view's structure as well.
    View(std::shared_ptr<const Scene> scene, const ViewRequest& request, const Parallel& parallel, Progress& progress);

    const Scene& scene() const { return *scene_; }
    const Tracer& tracer() const { return *tracer_; }
    const Plan& plan() const { return plan_; }

private:
    std::shared_ptr<const Scene> scene_;
    Plan plan_;
    std::unique_ptr<const Tracer> tracer_;
};

} // namespace raywise
