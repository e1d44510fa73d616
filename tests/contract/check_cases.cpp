#include "contract/check_cases.h"

#include "contract/check_answers.h"
#include "contract/exact_hits.h"
#include "contract/expand.h"
#include "contract/meshes.h"
#include "contract/numbers.h"

#include <algorithm>
#include <cmath>

namespace raywise::contract {
namespace {

constexpr std::size_t most_faults_per_case = 3;
// Numbers in the files are decimal and need not be exact; no case is about less than this.
constexpr double file_tolerance = 1e-12;

// What exact arithmetic says instead; empty: it agrees.
std::string contradiction(const Expectation& expectation, const ExactAnswers& exact, double tolerance) {
    const auto t_of = [](const ExactAnswer& answer) { return answer.t.convert_to<double>(); };
    const auto near = [&](double a, double b) { return a == b || std::fabs(a - b) <= tolerance; };
    const bool hit = !exact.touched.empty();
    const std::string count = std::to_string(exact.count()) + " in all";
    switch (expectation.kind) {
        case Expected::hit:
            return hit ? "" : "a miss";
        case Expected::miss:
            return hit ? "a hit at t " + text_of(t_of(exact.touched[0])) : "";
        case Expected::t:
            if (!hit) return "a miss";
            return near(t_of(exact.touched[0]), expectation.numbers[0]) ? "" : "t " + text_of(t_of(exact.touched[0]));
        case Expected::primitive:
        case Expected::lowest: {
            if (!hit) return "a miss";
            const auto& ids = expectation.ids;
            const PrimitiveId id = exact.touched[0].id;
            if (std::find(ids.begin(), ids.end(), id) != ids.end()) return "";
            return "triangle " + std::to_string(id.geometry) + ":" + std::to_string(id.primitive);
        }
        case Expected::count:
            if (!exact.count_certain) return "a number that depends on which side the ray is moved to";
            return exact.count() == static_cast<std::size_t>(expectation.numbers[0]) ? "" : count;
        case Expected::even:
        case Expected::outside:
            return exact.count() % 2 == 0 ? "" : count;
        case Expected::odd:
        case Expected::inside:
            return exact.count() % 2 == 1 ? "" : count;
        case Expected::all_t: {
            if (!exact.count_certain) return "hits that depend on which side the ray is moved to";
            std::vector<double> counted;
            for (const ExactAnswer& answer : exact.touched) {
                if (answer.counted) counted.push_back(t_of(answer));
            }
            const auto& numbers = expectation.numbers;
            return std::equal(counted.begin(), counted.end(), numbers.begin(), numbers.end(), near) ? "" : count;
        }
        case Expected::exact:
        case Expected::plane:
        case Expected::batch:
        case Expected::repeatable:
            return ""; // nothing that a file could get wrong
    }
    return "";
}

// A mesh that is to be refused has to have what it is refused for.
std::string fault_in_refusal(const ExpandedCase& expanded) {
    const std::string& kind = expanded.source->refusal;
    for (const Mesh& mesh : expanded.meshes) {
        const auto bad_vertex = [&](const Vec3& v) {
            if (kind == "not-finite") return !is_finite(v);
            return is_finite(v) && max_component(glm::abs(v)) > 3.4028234663852886e38; // float32's largest
        };
        const auto bad_triangle = [&](const std::array<std::uint32_t, 3>& triangle) {
            return std::any_of(triangle.begin(), triangle.end(),
                               [&](std::uint32_t corner) { return corner >= mesh.vertices.size(); });
        };
        if (kind == "index-range" ? std::any_of(mesh.triangles.begin(), mesh.triangles.end(), bad_triangle)
                                  : std::any_of(mesh.vertices.begin(), mesh.vertices.end(), bad_vertex)) {
            return "";
        }
    }
    return "nothing in the meshes is " + kind;
}

void check_case(const Family& family, const Case& source, std::uint64_t sweep_factor,
                std::vector<std::string>& faults) {
    const auto place = [&](int line) { return family.file + ":" + std::to_string(line) + ": "; };
    ExpandedCase expanded;
    try {
        expanded = expand(source, sweep_factor);
    } catch (const MeshFileAbsent&) {
        return; // nothing to look at on this machine
    }
    if (!source.refusal.empty()) {
        const std::string fault = fault_in_refusal(expanded);
        if (!fault.empty()) faults.push_back(place(source.line) + fault);
        return;
    }
    const ExactScene exact(expanded.meshes);
    std::size_t found = 0;
    for (const RayGroup& group : expanded.groups) {
        if (group.rays.empty()) faults.push_back(place(group.lines->line) + "the sweep has no rays");
        for (const Ray& ray : group.rays) {
            const ExactAnswers answers = exact.answers(ray);
            const double reach = exact.reach(ray);
            const double tolerance = std::isfinite(reach) ? file_tolerance * reach : 0.0;
            for (const Expectation& expectation : group.lines->expectations) {
                const std::string instead = contradiction(expectation, answers, tolerance);
                if (instead.empty() || ++found > most_faults_per_case) continue;
                faults.push_back(place(expectation.line) + "expects " + text_of(expectation) +
                                 ", but exact arithmetic finds " + instead + "; " + text_of(ray));
            }
        }
    }
}

} // namespace

std::vector<std::string> faults_of(const std::vector<Family>& families, std::uint64_t sweep_factor) {
    std::vector<std::string> faults;
    for (const Family& family : families) {
        for (const Case& source : family.cases) check_case(family, source, sweep_factor, faults);
    }
    return faults;
}

} // namespace raywise::contract
