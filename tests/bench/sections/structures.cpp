// Our structures beside each other, and beside Embree 3: what building takes, and a ray of each kind, one by one, in one thread.
#include "bench/sections/section.h"
#include "bench/subjects/raywise_subject.h"
#include "bench/table.h"

#include "base/structure.h"
#include "model/cost_units.h"
#include "model/machine.h"
#include "rays/rays.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace raywise::bench {
namespace {

constexpr const char* build_query = "build";
constexpr const char* section = "structures";

// A grid that expects few rays is another one than that of many.
constexpr std::uint64_t few_rays = 100;
constexpr std::uint64_t many_rays = 10'000'000;

struct Candidate {
    const Subject* subject;
    std::string label;
    std::uint64_t rays;
};

// Ours are made here, as no other section asks them all; Embree's are the session's.
struct Candidates {
    explicit Candidates(Session& session) {
        for (const Structure structure : all_structures()) {
            const std::string name = name_of(structure);
            if (needs_view(structure) || !has_structure(session.library, name)) continue;
            ours.push_back(
                raywise_subject({name, name_of(structure), this_machine().instruction_set}, session.library));
            all.push_back({ours.back().get(), name, many_rays});
            if (differs_by_rays(structure)) all.push_back({ours.back().get(), name + ", few rays", few_rays});
        }
        for (const auto& subject : session.subjects) {
            for (const char* peer : {"Embree 3 LOW", "Embree 3 MEDIUM", "Embree 3 HIGH"}) {
                if (subject->name() == peer) all.push_back({subject.get(), peer, many_rays});
            }
        }
    }

    Subjects ours;
    std::vector<Candidate> all;
};

BuildRequest request_for(const SceneUnderTest& scene, const Candidate& candidate) {
    BuildRequest request{scene.mesh()};
    request.count = candidate.rays;
    return request;
}

void measure_builds(SceneUnderTest& scene, const Candidates& candidates) {
    Session& session = scene.session();
    session.show_progress("structures, building");
    Cell cell = scene.cell(section, "", Question::closest);
    cell.query = build_query;
    cell.unit = "ms";
    cell.higher_is_better = false;
    std::vector<calibration::Timed> timed;
    for (const Candidate& candidate : candidates.all)
        timed.push_back(timed_build(*candidate.subject, request_for(scene, candidate), calibration::processor_ns));
    const std::vector<calibration::Timing> timings = time_in_turns(timed, session.effort.build_timing);
    for (std::size_t i = 0; i < timings.size(); ++i) {
        Value value;
        value.subject = candidates.all[i].label;
        value.peer = candidates.all[i].subject->traits().peer;
        value.value = timings[i].ns * 1e-6;
        value.spread = timings[i].spread;
        value.repetitions = timings[i].repetitions;
        cell.values.push_back(std::move(value));
    }
    session.cells.push_back(std::move(cell));
}

void measure_rays(SceneUnderTest& scene, const Candidates& candidates) {
    Session& session = scene.session();
    std::vector<std::unique_ptr<Built>> built;
    for (const Candidate& candidate : candidates.all)
        built.push_back(candidate.subject->build(request_for(scene, candidate)));
    const auto& kinds = workloads::ray_distributions();
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        if (!session.wants_rays(kinds[kind].name) || !scene.has_rays(kind)) continue;
        session.show_progress(std::string("structures, ") + kinds[kind].name);
        const Question question = kinds[kind].any_hit ? Question::any : Question::closest;
        const double pass_ns = session.effort.single_pass_ns / 4.0;
        const RaySet rays =
            scene.rays(kind, affordable_rays(scene, kind, question, session.effort.single_rays, pass_ns));
        if (rays.size() == 0) continue;
        Cell cell = scene.cell(section, kinds[kind].name, question);
        cell.count = rays.size();
        std::vector<Entry> entries;
        for (std::size_t i = 0; i < built.size(); ++i) {
            // Who is slow is asked fewer of the same rays.
            const RaySet few = one_in(rays, thinned_by(*built[i], rays, question, 4.0 * pass_ns));
            QueryRequest request{few};
            request.question = question;
            entries.push_back(
                {candidates.all[i].subject, candidates.all[i].label, built[i]->query(request), few.size(), {}});
        }
        // Hits of different rays cannot be compared; hit_counts and the tests do that.
        std::vector<calibration::Timed> timed;
        for (const Entry& entry : entries)
            timed.push_back(
                calibration::with_clock([&entry] { entry.query->ask(0, entry.rays); }, calibration::processor_ns));
        const std::vector<calibration::Timing> timings = time_in_turns(timed, session.effort.timing);
        for (std::size_t i = 0; i < entries.size(); ++i) {
            Value value;
            value.subject = entries[i].label;
            value.peer = entries[i].subject->traits().peer;
            value.value = 1e3 * static_cast<double>(entries[i].rays) / timings[i].ns;
            value.spread = timings[i].spread;
            value.repetitions = timings[i].repetitions;
            cell.values.push_back(std::move(value));
        }
        session.cells.push_back(std::move(cell));
    }
}

const Cell* find(const Session& session, const std::string& scene, const std::string& rays) {
    for (const Cell& cell : session.cells) {
        if (cell.section == section && cell.scene == scene && cell.rays == rays) return &cell;
    }
    return nullptr;
}

} // namespace

void measure_structures(SceneUnderTest& scene) {
    const Candidates candidates(scene.session());
    measure_builds(scene, candidates);
    measure_rays(scene, candidates);
}

std::string structures_table(const Session& session) {
    std::string text;
    for (const Cell& build : session.cells) {
        if (build.section != section || build.query != build_query) continue;
        std::vector<std::string> columns = {build.scene, "ns/triangle", "LOW over"};
        for (const auto& kind : workloads::ray_distributions()) {
            columns.push_back(std::string(kind.name) + ", ns");
            columns.emplace_back("of MEDIUM");
            columns.emplace_back("of bvh");
        }
        Table table("Structures, one thread; rays one by one, speed over that of Embree 3 MEDIUM and of bvh", columns);
        for (const Value& value : build.values) {
            const auto ratio = [&](const Cell* cell, const char* other) {
                const Value* const ours = cell != nullptr ? cell->of(value.subject) : nullptr;
                const Value* const theirs = cell != nullptr ? cell->of(other) : nullptr;
                return ours != nullptr && theirs != nullptr ? ratio_text(cell->ratio(*ours, *theirs))
                                                            : std::string("-");
            };
            std::vector<std::string> row = {value.subject,
                                            digits(value.value * 1e6 / static_cast<double>(build.triangles)),
                                            ratio(&build, "Embree 3 LOW")};
            for (const auto& kind : workloads::ray_distributions()) {
                const Cell* const cell = find(session, build.scene, kind.name);
                const Value* const speed = cell != nullptr ? cell->of(value.subject) : nullptr;
                row.push_back(speed != nullptr ? digits(1e3 / speed->value) : "-");
                row.push_back(ratio(cell, "Embree 3 MEDIUM"));
                row.push_back(ratio(cell, "bvh"));
            }
            table.add(row);
        }
        if (!table.empty()) text += table.text();
    }
    return text;
}

} // namespace raywise::bench
