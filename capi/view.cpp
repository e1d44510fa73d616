// Views: making them, and the same questions as to a scene.
#include "query.h"

#include <cmath>

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

std::int32_t rw_view_create(const rw_scene* scene, const rw_view_options* options, const rw_commit_options* commit,
                            rw_view** view) {
    return guard([&] {
        const std::shared_ptr<Scene>& s = required(scene, "scene").value;
        s->tracer(); // an error unless committed
        rw_view*& out = required(view, "view");
        const rw_view_options o = read_struct(options, "options");
        read_reserved(o.reserved, "options");
        const rw_commit_options c = read_optional_struct(commit, "commit");
        ViewRequest request;
        request.frame = read_frame(o);
        request.workload =
            read_workload(o.count, o.ray_kind == RW_RAYS_ANY_KIND ? RW_RAYS_CAMERA : o.ray_kind, "options");
        request.forced = read_structure(o.structure);
        Progress progress(read_progress(c.progress, c.progress_user));
        const Parallel parallel = read_parallel(c.threads, c.parallel_for, c.parallel_user);
        out = new rw_view(std::make_shared<const View>(s, request, parallel, progress));
    });
}

std::int32_t rw_view_retain(const rw_view* view) {
    return guard([&] { retain(view, "view"); });
}

std::int32_t rw_view_release(const rw_view* view) {
    return guard([&] { release(view); });
}

std::int32_t rw_view_intersect(const rw_view* view, const rw_ray* ray, rw_hit* hit) {
    return guard([&] { intersect(required(view, "view").value->tracer(), ray, hit); });
}

std::int32_t rw_view_occluded(const rw_view* view, const rw_ray* ray, std::int32_t* answer) {
    return guard([&] { occluded(required(view, "view").value->tracer(), ray, answer); });
}

std::int32_t rw_view_intersect_all(const rw_view* view, const rw_ray* ray, rw_hit* hits, std::uint64_t capacity,
                                   std::uint64_t* needed) {
    return guard(
        [&] { intersect_all_with(required(view, "view").value->tracer(), ray, nullptr, hits, capacity, needed); });
}

std::int32_t rw_view_intersect_with(const rw_view* view, const rw_ray* ray, const rw_ray_options* options,
                                    rw_hit* hit) {
    return guard([&] { intersect_with(required(view, "view").value->tracer(), ray, options, hit); });
}

std::int32_t rw_view_occluded_with(const rw_view* view, const rw_ray* ray, const rw_ray_options* options,
                                   std::int32_t* answer) {
    return guard([&] { occluded_with(required(view, "view").value->tracer(), ray, options, answer); });
}

std::int32_t rw_view_intersect_all_with(const rw_view* view, const rw_ray* ray, const rw_ray_options* options,
                                        rw_hit* hits, std::uint64_t capacity, std::uint64_t* needed) {
    return guard(
        [&] { intersect_all_with(required(view, "view").value->tracer(), ray, options, hits, capacity, needed); });
}

std::int32_t rw_view_intersect_batch(const rw_view* view, const rw_rays* rays, const rw_hits* hits,
                                     const rw_query_options* options) {
    return guard([&] { intersect_batch(required(view, "view").value->tracer(), rays, hits, options); });
}

std::int32_t rw_view_occluded_batch(const rw_view* view, const rw_rays* rays, const rw_output* answers,
                                    const rw_query_options* options) {
    return guard([&] { occluded_batch(required(view, "view").value->tracer(), rays, answers, options); });
}

std::int32_t rw_view_intersect_all_batch(const rw_view* view, const rw_rays* rays, std::uint64_t* offsets,
                                         const rw_hits* hits, std::uint64_t capacity, std::uint64_t* needed,
                                         const rw_query_options* options) {
    return guard([&] {
        intersect_all_batch(required(view, "view").value->tracer(), rays, offsets, hits, capacity, needed, options);
    });
}

std::int32_t rw_view_candidate_count(const rw_view* view, std::uint32_t* count) {
    return guard([&] {
        required(view, "view").value->plan();
        candidate_count(count);
    });
}

std::int32_t rw_view_get_candidate(const rw_view* view, std::uint32_t index, rw_candidate* candidate) {
    return guard([&] {
        const View& value = *required(view, "view").value;
        get_candidate(value.plan(), value.tracer(), index, candidate);
    });
}

std::int32_t rw_view_explain(const rw_view* view, std::int32_t format, char* buffer, std::uint64_t capacity,
                             std::uint64_t* needed) {
    return guard([&] {
        const View& value = *required(view, "view").value;
        return explain(value.plan(), value.tracer(), *value.scene().profile(), format, buffer, capacity, needed);
    });
}

} // extern "C"
