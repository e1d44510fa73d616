// Why a scene, or a view of one, has the structure that it has.
#include "scene/explain.h"
#include "convert.h"
#include "guard.h"

using namespace raywise;
using namespace raywise::capi;

extern "C" {

std::int32_t rw_scene_candidate_count(const rw_scene* scene, std::uint32_t* count) {
    return guard([&] {
        required(scene, "scene").value->plan(); // an error unless committed
        required(count, "count") = static_cast<std::uint32_t>(structure_count);
    });
}

std::int32_t rw_scene_get_candidate(const rw_scene* scene, std::uint32_t index, rw_candidate* candidate) {
    return guard([&] {
        const Scene& s = *required(scene, "scene").value;
        s.plan(); // an error unless committed
        if (index >= structure_count) {
            throw Error(Status::ERROR_INVALID_ARGUMENT,
                        "index: " + std::to_string(index) + " is not below " + std::to_string(structure_count));
        }
        const CandidateReport report = report_candidate(s.plan(), s.tracer(), static_cast<Structure>(index));
        const PlannedCandidate& figures = report.figures;
        rw_candidate facts{};
        facts.flags = (report.chosen ? RW_CANDIDATE_CHOSEN : 0u) | (report.forced ? RW_CANDIDATE_FORCED : 0u) |
                      (figures.over_limit ? RW_CANDIDATE_OVER_LIMIT : 0u) |
                      (figures.measured ? RW_CANDIDATE_MEASURED : 0u) |
                      (figures.applicable ? 0u : RW_CANDIDATE_NOT_APPLICABLE);
        facts.structure = name_of(report.structure);
        facts.predicted_build_ns = figures.predicted.build_ns;
        facts.predicted_ray_ns = figures.predicted.ray_ns;
        facts.predicted_error = figures.predicted.error;
        facts.predicted_total_ns = report.predicted_total_ns;
        facts.break_even_rays = report.break_even_rays;
        facts.predicted_bytes = static_cast<std::uint64_t>(figures.predicted.bytes);
        facts.actual_bytes = figures.actual_bytes;
        facts.actual_build_ns = figures.actual_build_ns;
        facts.actual_ray_ns = figures.actual_ray_ns;
        write_struct(candidate, "candidate", facts);
    });
}

std::int32_t rw_scene_explain(const rw_scene* scene, std::int32_t format, char* buffer, std::uint64_t capacity,
                              std::uint64_t* needed) {
    return guard([&] {
        const Scene& s = *required(scene, "scene").value;
        const auto text = is_json(format) ? explain_json : explain_text;
        return write_text(text(s.plan(), s.tracer(), *s.profile()), buffer, capacity, needed);
    });
}

} // extern "C"
