// Building: from the caller's arrays, used in place, to a scene that can be asked. Giving it back is not counted.
#include "bench/sections/section.h"
#include "bench/table.h"

namespace raywise::bench {
namespace {

void measure(SceneUnderTest& scene, unsigned threads) {
    Session& session = scene.session();
    session.show_progress("building, threads: " + std::to_string(threads));
    const calibration::Clock clock = threads == 1 ? calibration::processor_ns : calibration::now_ns;
    BuildRequest request{scene.mesh()};
    request.threads = threads;
    Cell cell = scene.cell("build", "", Question::closest);
    cell.query = "build";
    cell.unit = "ms";
    cell.higher_is_better = false;
    cell.threads = threads;
    std::vector<const Subject*> taking_part;
    std::vector<calibration::Timed> candidates;
    for (const auto& subject : session.subjects) {
        // What is chosen for it differs from one count of rays to the next: see the totals.
        if (subject->traits().chooses || !session.fits(*subject, scene.triangles())) continue;
        // One that builds in one thread alone has nothing to show with more.
        if (subject->traits().slow && threads > 1) continue;
        taking_part.push_back(subject.get());
        candidates.push_back(timed_build(*subject, request, clock));
    }
    const std::vector<calibration::Timing> timings = time_in_turns(candidates, session.effort.build_timing);
    for (std::size_t i = 0; i < taking_part.size(); ++i) {
        Value value;
        value.subject = taking_part[i]->name();
        value.peer = taking_part[i]->traits().peer;
        value.robust = taking_part[i]->traits().robust;
        value.value = timings[i].ns * 1e-6;
        value.spread = timings[i].spread;
        value.repetitions = timings[i].repetitions;
        cell.values.push_back(std::move(value));
    }
    session.cells.push_back(std::move(cell));
}

} // namespace

void measure_build(SceneUnderTest& scene) {
    measure(scene, 1);
    if (scene.session().all_threads > 1) measure(scene, scene.session().all_threads);
}

std::string build_table(const Session& session) {
    Table table("Building, ns per triangle (ms of ours in front); the ratios are time of Embree 3 over ours",
                {"scene", "threads", "ms", "bvh", "LOW", "MEDIUM", "HIGH", "over MEDIUM", "bvh_quality", "over HIGH",
                 "bvh_morton", "over LOW"});
    for (const Cell& cell : session.cells) {
        if (cell.section != "build") continue;
        const auto per_triangle = [&](const Value* value) {
            return value != nullptr ? digits(value->value * 1e6 / static_cast<double>(cell.triangles)) : "-";
        };
        const auto over = [&](const Value* ours, const Value* peer) {
            return ours != nullptr && peer != nullptr ? ratio_text(cell.ratio(*ours, *peer)) : "-";
        };
        const Value* const ours = cell.of(ours_forced);
        const Value* const quality = cell.of(ours_quality);
        const Value* const morton = cell.of(ours_morton);
        table.add({cell.scene, std::to_string(cell.threads), ours != nullptr ? digits(ours->value) : "-",
                   per_triangle(ours), per_triangle(cell.of("Embree 3 LOW")), per_triangle(cell.of("Embree 3 MEDIUM")),
                   per_triangle(cell.of("Embree 3 HIGH")), over(ours, cell.of("Embree 3 MEDIUM")),
                   per_triangle(quality), over(quality, cell.of("Embree 3 HIGH")), per_triangle(morton),
                   over(morton, cell.of("Embree 3 LOW"))});
    }
    return table.empty() ? std::string() : table.text();
}

} // namespace raywise::bench
