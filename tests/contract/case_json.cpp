#include "contract/case_json.h"

#include "contract/exact_hits.h"
#include "contract/expand.h"
#include "contract/meshes.h"
#include "contract/numbers.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace raywise::contract {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no words for what is not finite.
Json json_of(double x) { return std::isfinite(x) ? Json(x) : Json(text_of(x)); }

Json json_of(const Ray& ray) {
    Json array = Json::array();
    for (int axis = 0; axis < 3; ++axis) array.push_back(json_of(ray.origin[axis]));
    for (int axis = 0; axis < 3; ++axis) array.push_back(json_of(ray.direction[axis]));
    array.push_back(json_of(ray.tmin));
    array.push_back(json_of(ray.tmax));
    return array;
}

Json json_of(const PrimitiveId& id) { return Json::array({id.geometry, id.primitive}); }

Json json_of(const Mesh& mesh) {
    Json vertices = Json::array();
    for (const Vec3& v : mesh.vertices) vertices.push_back({json_of(v.x), json_of(v.y), json_of(v.z)});
    Json triangles = Json::array();
    for (const auto& t : mesh.triangles) triangles.push_back({t[0], t[1], t[2]});
    return {{"precision", mesh.float32 ? "float32" : "float64"},
            {"skip_invalid", mesh.skip_invalid},
            {"vertices", std::move(vertices)},
            {"triangles", std::move(triangles)}};
}

Json json_of(const Expectation& expectation) {
    Json json = {{"kind", describe(expectation.kind).word}};
    if (!expectation.numbers.empty()) {
        for (const double number : expectation.numbers) json["numbers"].push_back(json_of(number));
    }
    for (const PrimitiveId& id : expectation.ids) json["ids"].push_back(json_of(id));
    return json;
}

// [t, geometry, primitive, counted] of every triangle touched.
Json json_of(const ExactAnswers& answers) {
    Json touched = Json::array();
    for (const ExactAnswer& answer : answers.touched) {
        touched.push_back(
            {json_of(answer.t.convert_to<double>()), answer.id.geometry, answer.id.primitive, answer.counted});
    }
    return {{"touched", std::move(touched)}, {"count_certain", answers.count_certain}};
}

bool wants_exact(const RayLines& lines) {
    return std::any_of(lines.expectations.begin(), lines.expectations.end(), [](const Expectation& expectation) {
        return expectation.kind == Expected::exact || expectation.kind == Expected::plane;
    });
}

Json json_of(const RayGroup& group, const ExactScene& exact) {
    Json json = {{"line", group.lines->line}, {"sweep", group.lines->sweep}, {"rays", Json::array()}};
    for (const Ray& ray : group.rays) {
        json["rays"].push_back(json_of(ray));
        json["reach"].push_back(json_of(exact.reach(ray)));
    }
    for (const Expectation& expectation : group.lines->expectations)
        json["expectations"].push_back(json_of(expectation));
    if (wants_exact(*group.lines)) {
        for (const Ray& ray : group.rays) json["exact"].push_back(json_of(exact.answers(ray)));
    }
    return json;
}

Json json_of(const Case& source, std::uint64_t sweep_factor) {
    Json json = {{"name", source.name},
                 {"about", source.about},
                 {"source", source.source},
                 {"convention", source.convention},
                 {"precision", source.float32 ? "float32" : "float64"},
                 {"refusal", source.refusal},
                 {"mention", source.mention},
                 {"skipped", ""},
                 {"geometries", Json::array()},
                 {"groups", Json::array()}};
    try {
        const ExpandedCase expanded = expand(source, sweep_factor);
        const ExactScene exact(expanded.meshes);
        for (const Mesh& mesh : expanded.meshes) json["geometries"].push_back(json_of(mesh));
        for (const RayGroup& group : expanded.groups) json["groups"].push_back(json_of(group, exact));
    } catch (const MeshFileAbsent& absent) {
        json["skipped"] = absent.what();
    }
    return json;
}

const char* word_of(Outcome outcome) {
    return outcome == Outcome::passed ? "passed" : outcome == Outcome::failed ? "failed" : "skipped";
}

} // namespace

Json export_of(const std::vector<Family>& families, std::uint64_t sweep_factor) {
    Json json = {{"format", 1}, {"families", Json::array()}};
    for (const Family& family : families) {
        Json cases = Json::array();
        for (const Case& source : family.cases) cases.push_back(json_of(source, sweep_factor));
        json["families"].push_back(
            {{"name", family.name}, {"about", family.about}, {"file", family.file}, {"cases", std::move(cases)}});
    }
    return json;
}

Json report_of(const std::vector<LibraryResult>& results) {
    Json rows = Json::array();
    Json libraries = Json::object();
    std::map<std::string, bool> cases; // judged by some library -> passed by all that judged it
    for (const LibraryResult& result : results) {
        for (const CaseResult& one : result.cases) {
            rows.push_back({{"library", result.library},
                            {"family", one.family},
                            {"case", one.name},
                            {"outcome", word_of(one.outcome)},
                            {"reason", one.reason},
                            {"convention", !one.convention.empty()},
                            {"failed_questions", one.failed_questions},
                            {"rays", one.rays},
                            {"failed_rays", one.failed_rays}});
            if (one.outcome == Outcome::skipped) continue;
            bool& passed = cases.emplace(one.family + "/" + one.name, true).first->second;
            passed = passed && one.outcome == Outcome::passed;
        }
        libraries[result.library] = {{"hard_cases", result.count(Outcome::passed) + result.count(Outcome::failed)},
                                     {"hard_cases_passed", result.count(Outcome::passed)},
                                     {"hard_cases_passed_by_closest", result.passed_by_closest()},
                                     {"hard_cases_skipped", result.count(Outcome::skipped)}};
    }
    const auto passed = std::count_if(cases.begin(), cases.end(), [](const auto& entry) { return entry.second; });
    return {{"rows", std::move(rows)},
            {"summary",
             {{"hard_cases", cases.size()}, {"hard_cases_passed", passed}, {"libraries", std::move(libraries)}}}};
}

} // namespace raywise::contract
