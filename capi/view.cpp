// Views: scenes for rays that share an origin or a direction.
#include "convert.h"
#include "guard.h"

using namespace raywise;
using namespace raywise::capi;

namespace {

ViewFrame read_frame(const rw_view_options& options) {
    ViewFrame frame;
    frame.origin = {options.origin[0], options.origin[1], options.origin[2]};
    frame.direction = {options.direction[0], options.direction[1], options.direction[2]};
    if (!is_finite(frame.origin))
        throw Error(Status::ERROR_NOT_FINITE, "options.origin: a coordinate is NaN or infinite");
    if (!is_finite(frame.direction))
        throw Error(Status::ERROR_NOT_FINITE, "options.direction: a coordinate is NaN or infinite");
    const bool directed = frame.direction != Vec3(0.0);
    if (options.kind == RW_VIEW_DIRECTION) {
        if (!directed)
            throw Error(Status::ERROR_INVALID_ARGUMENT,
                        "options.direction: a view along a direction needs one that is not zero");
        frame.kind = ViewFrame::Kind::direction;
        return frame;
    }
    if (options.kind != RW_VIEW_POINT) {
        throw Error(Status::ERROR_INVALID_ARGUMENT,
                    "options.kind: " + std::to_string(options.kind) + " is no kind of view");
    }
    constexpr double half_pi = 1.5707963267948966;
    if (!(options.half_angle >= 0.0 && options.half_angle < half_pi)) {
        throw Error(Status::ERROR_INVALID_ARGUMENT, "options.half_angle: it is not between 0 and pi/2");
    }
    if (directed) frame.half_angle = options.half_angle > 0.0 ? options.half_angle : half_pi / 2.0;
    return frame;
}

} // namespace

extern "C" {

std::int32_t rw_scene_view(const rw_scene* scene, const rw_view_options* options, const rw_commit_options* commit,
                           rw_scene** view) {
    return guard([&] {
        const std::shared_ptr<Scene>& s = required(scene, "scene").value;
        s->tracer(); // an error unless committed
        rw_scene*& out = required(view, "view");
        const rw_view_options o = read_struct(options, "options");
        read_reserved(o.reserved, "options");
        const rw_commit_options c = read_commit_options(commit, "commit");
        ViewRequest request;
        request.frame = read_frame(o);
        request.workload =
            read_workload(o.count, o.ray_kind == RW_RAYS_ANY_KIND ? RW_RAYS_CAMERA : o.ray_kind, "options");
        request.forced = read_structure(o.structure);
        Progress progress(read_progress(c.progress, c.progress_user));
        out =
            new rw_scene(Scene::seen(s, request, read_parallel(c.threads, c.parallel_for, c.parallel_user), progress));
    });
}

} // extern "C"
