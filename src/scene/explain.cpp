#include "scene/explain.h"

#include "base/format.h"
#include "model/json_writer.h"

#include <algorithm>
#include <cmath>

namespace raywise {
namespace {

constexpr const char* effort_names[] = {"estimate", "probe", "measure"};
constexpr const char* rule_names[] = {"smallest_total", "hapala"};
constexpr const char* kind_names[] = {"any kind", "random", "camera", "shadow", "diffuse"};
constexpr const char* source_names[] = {"generic", "path", "environment", "user", "system"};

// What the vertices are given in; null where there are none.
const char* precision_of(const Primitives& primitives) {
    bool float32 = false;
    bool float64 = false;
    for (const auto& mesh : primitives.meshes()) (mesh->is_float32() ? float32 : float64) = true;
    if (float32 && float64) return "float32 and float64";
    return float32 ? "float32" : float64 ? "float64" : nullptr;
}

// At most 22 columns, which is what the table leaves of 100. "above": better above so many.
std::string remark(const CandidateReport& candidate) {
    if (candidate.forced) return "forced";
    if (candidate.chosen) return "chosen";
    if (!candidate.figures.applicable) return "not applicable";
    if (candidate.figures.over_limit) return "over the memory limit";
    if (std::isinf(candidate.break_even_rays)) return "never better";
    if (candidate.break_even_rays <= 1.0) return "better at once";
    if (candidate.break_even_rays >= 1e9) return format("above %.1e rays", candidate.break_even_rays);
    return "above " + grouped_text(static_cast<std::uint64_t>(candidate.break_even_rays)) + " rays";
}

} // namespace

CandidateReport report_candidate(const Plan& plan, const Tracer& tracer, Structure structure) {
    CandidateReport report;
    report.structure = structure;
    report.figures = plan.candidate(structure);
    report.chosen = structure == plan.chosen;
    report.forced = report.chosen && plan.forced;
    if (plan.workload.rays) {
        report.predicted_total_ns = report.figures.predicted.total_ns(static_cast<double>(*plan.workload.rays));
    }
    if (report.chosen) {
        const std::uint64_t rays = tracer.usage().rays.load(std::memory_order_relaxed);
        if (rays > 0) {
            report.figures.actual_ray_ns =
                static_cast<double>(tracer.usage().batch_ns.load(std::memory_order_relaxed)) /
                static_cast<double>(rays);
        }
    } else {
        report.break_even_rays = break_even_rays(plan.candidate(plan.chosen).predicted, report.figures.predicted);
    }
    return report;
}

std::string explain_text(const Plan& plan, const Tracer& tracer, const Profile& profile) {
    std::string text;
    text += "scene: " + grouped_text(tracer.primitives().count()) + " triangles, ";
    text += plan.workload.rays ? grouped_text(*plan.workload.rays) + " rays expected"
                               : std::string("number of rays unknown");
    text += format(" (%s), effort %s, rule %s\n", kind_names[static_cast<int>(plan.workload.kind)],
                   effort_names[static_cast<int>(plan.effort)], rule_names[static_cast<int>(plan.rule)]);
    const char* const precision = precision_of(tracer.primitives());
    if (precision != nullptr) text += std::string("vertices: ") + precision + "\n";
    const SceneFeatures& seen = plan.features;
    text += format("a line through the scene: %.3g boxes of triangles, %.3g cells of a grid, %.3g of them filled\n",
                   seen.boxes, seen.cells, seen.filled);
    text += format("a triangle: in %.3g cells, %.3g triangles in one\n", seen.references, seen.crowding);
    text += std::string("calibration: ") + source_names[static_cast<int>(profile.source)] + ", measured " +
            profile.provenance.date + "\n";
    if (!profile.path.empty()) text += "profile: " + profile.path + "\n"; // of any length
    if (profile.status != Status::OK) text += "passed over: " + profile.reason + "\n";
    if (plan.hapala) {
        text +=
            format("Hapala: kd-tree predicted %s to build, %s a ray; critical number of rays %.3g: %s\n",
                   duration_text(plan.hapala->tree_build_ns).c_str(), duration_text(plan.hapala->tree_ray_ns).c_str(),
                   plan.hapala->critical_rays, plan.hapala->keep_grid ? "keep the grid" : "build the kd-tree");
    }
    if (plan.refit && plan.refit->refits > 0) {
        text += format("refitted: %s times since it was built; a ray is reckoned at %.3g of what it was then\n",
                       grouped_text(plan.refit->refits).c_str(), plan.refit->cost);
    } else if (plan.refit) {
        text += format("not refitted but built anew: %s\n", plan.refit->obstacle);
    }
    text += format("  %-13s %8s %8s %5s %8s %8s  %8s %8s  %s\n", "structure", "build", "per ray", "+/-", "bytes",
                   "total", "build*", "per ray*", "better");
    for (const Structure structure : all_structures()) {
        const CandidateReport candidate = report_candidate(plan, tracer, structure);
        const PlannedCandidate& figures = candidate.figures;
        text += format(
            "%c %-13s %8s %8s %4.0f%% %8s %8s  %8s %8s  ", candidate.chosen ? '>' : ' ', name_of(structure),
            duration_text(figures.predicted.build_ns).c_str(), duration_text(figures.predicted.ray_ns).c_str(),
            100.0 * figures.predicted.error,
            size_text(figures.actual_bytes != 0 ? static_cast<double>(figures.actual_bytes) : figures.predicted.bytes)
                .c_str(),
            duration_text(candidate.predicted_total_ns).c_str(), duration_text(figures.actual_build_ns).c_str(),
            duration_text(figures.actual_ray_ns).c_str());
        text += remark(candidate) + "\n";
    }
    const std::uint64_t rays = tracer.usage().rays.load(std::memory_order_relaxed);
    text += "* actual; per ray: wall time of " +
            (rays > 0 ? grouped_text(rays) + " rays in batches so far" : std::string("the sample")) +
            "; deciding took " + duration_text(plan.decide_ns) + "\n";
    return text;
}

std::string explain_json(const Plan& plan, const Tracer& tracer, const Profile& profile) {
    JsonWriter json;
    json.open_object();
    json.put("triangles", tracer.primitives().count());
    json.put("hittable_triangles", tracer.primitives().hittable_count());
    if (const char* const precision = precision_of(tracer.primitives())) {
        json.put("vertices", precision);
    } else {
        json.put_null("vertices");
    }
    if (plan.workload.rays) {
        json.put("expected_rays", *plan.workload.rays);
    } else {
        json.put_null("expected_rays");
    }
    json.put("ray_kind", kind_names[static_cast<int>(plan.workload.kind)]);
    json.put("effort", effort_names[static_cast<int>(plan.effort)]);
    json.put("rule", rule_names[static_cast<int>(plan.rule)]);

    json.open_object("features");
    for (const SceneFeature& feature : scene_features) json.put(feature.name, plan.features.*feature.value);
    json.close_object();

    json.open_object("calibration");
    json.put("source", source_names[static_cast<int>(profile.source)]);
    json.put("path", profile.path);
    json.put("date", profile.provenance.date);
    json.put("status", static_cast<int>(profile.status));
    json.put("reason", profile.reason);
    json.close_object();

    if (plan.hapala) {
        json.open_object("hapala");
        json.put("tree_build_ns", plan.hapala->tree_build_ns);
        json.put("tree_ray_ns", plan.hapala->tree_ray_ns);
        json.put("critical_rays", plan.hapala->critical_rays);
        json.put("keep_grid", plan.hapala->keep_grid);
        json.close_object();
    }
    if (plan.refit) {
        json.open_object("refit");
        json.put("refits", plan.refit->refits);
        json.put("cost", plan.refit->cost);
        json.put("obstacle", plan.refit->obstacle);
        json.close_object();
    } else {
        json.put_null("refit");
    }
    json.put("chosen", name_of(plan.chosen));
    json.put("forced", plan.forced);
    json.put("decide_ns", plan.decide_ns);

    json.open_list("candidates");
    for (const Structure structure : all_structures()) {
        const CandidateReport candidate = report_candidate(plan, tracer, structure);
        const PlannedCandidate& figures = candidate.figures;
        json.open_object();
        json.put("structure", name_of(structure));
        json.put("chosen", candidate.chosen);
        json.put("applicable", figures.applicable);
        json.put("over_limit", figures.over_limit);
        json.put("measured", figures.measured);
        json.put("predicted_build_ns", figures.predicted.build_ns);
        json.put("predicted_ray_ns", figures.predicted.ray_ns);
        json.put("predicted_error", figures.predicted.error);
        json.put("predicted_bytes", figures.predicted.bytes);
        json.put("predicted_total_ns", candidate.predicted_total_ns);
        json.put("break_even_rays", candidate.break_even_rays);
        json.put("actual_build_ns", figures.actual_build_ns);
        json.put("actual_ray_ns", figures.actual_ray_ns);
        if (figures.actual_bytes != 0) {
            json.put("actual_bytes", figures.actual_bytes);
        } else {
            json.put_null("actual_bytes");
        }
        json.close_object();
    }
    json.close_list();
    json.put("rays", tracer.usage().rays.load(std::memory_order_relaxed));
    json.put("invalid_rays", tracer.usage().invalid_rays.load(std::memory_order_relaxed));
    json.close_object();
    return json.finish();
}

} // namespace raywise
