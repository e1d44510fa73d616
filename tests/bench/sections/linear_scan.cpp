// The structure that is none: per triangle and ray, for single rays, small batches and larger ones; and one ray over a mesh never
// seen before, with all that has to be done for it.
#include "bench/sections/section.h"
#include "bench/subjects/raywise_subject.h"
#include "bench/table.h"

#include <algorithm>

namespace raywise::bench {
namespace {

constexpr std::size_t random_rays = 0; // in workloads::ray_distributions()
constexpr std::uint64_t most_triangles = 1000000;
constexpr double per_pass = 3e7; // triangles seen by all rays of one repetition

struct Way {
    const char* name;
    Call call;
    std::size_t rays_per_call;
};
constexpr Way ways[] = {
    {"single", Call::single, 1}, {"batches of 8", Call::batch, 8}, {"batches of 1000", Call::batch, 1000}};

void add(Session& session, Cell cell, const char* query, const std::string& subject, const calibration::Timing& timing,
         double rays) {
    cell.query = query;
    Value value;
    value.subject = subject;
    value.value = timing.ns / rays / static_cast<double>(cell.triangles);
    value.spread = timing.spread;
    value.repetitions = timing.repetitions;
    cell.values.push_back(std::move(value));
    session.cells.push_back(std::move(cell));
}

} // namespace

void measure_linear_scan(SceneUnderTest& scene) {
    Session& session = scene.session();
    if (scene.triangles() > most_triangles || !session.wants_rays("random")) return;
    session.show_progress("linear scan");
    const std::unique_ptr<Subject> scan = raywise_subject({"raywise linear_scan", "linear_scan", {}}, session.library);
    Cell cell = scene.cell("linear_scan", "random", Question::closest);
    cell.unit = "ns/triangle";
    cell.higher_is_better = false;

    BuildRequest build{scene.mesh()};
    build.count = 1000;
    const std::unique_ptr<Built> built = scan->build(build);
    for (const Way& way : ways) {
        // As many calls as make a pass long enough to be timed.
        const auto affordable = static_cast<std::size_t>(per_pass / static_cast<double>(scene.triangles()));
        const std::size_t calls =
            std::clamp<std::size_t>(affordable / way.rays_per_call, 1, 100000 / way.rays_per_call);
        const RaySet rays = scene.rays(random_rays, calls * way.rays_per_call);
        QueryRequest request{rays};
        request.call = way.call;
        const std::unique_ptr<Query> query = built->query(request);
        const auto ask = [&] {
            for (std::size_t first = 0; first < rays.size(); first += way.rays_per_call)
                query->ask(first, first + way.rays_per_call);
        };
        const auto timings =
            time_in_turns({calibration::with_clock(ask, calibration::processor_ns)}, session.effort.timing);
        cell.count = way.rays_per_call;
        add(session, cell, way.name, scan->name(), timings.front(), static_cast<double>(rays.size()));
    }

    const RaySet one = scene.rays(random_rays, 1);
    build.count = 1;
    const auto cold = [&] {
        const std::unique_ptr<Built> fresh = scan->build(build);
        fresh->query({one})->ask(0, 1);
    };
    const auto timings =
        time_in_turns({calibration::with_clock(cold, calibration::processor_ns)}, session.effort.timing);
    cell.count = 1;
    add(session, cell, "cold, one ray", scan->name(), timings.front(), 1.0);
}

std::string linear_scan_table(const Session& session) {
    Table table("Linear scan, 1 thread: ns per triangle and ray",
                {"scene", "triangles", "single", "batches of 8", "batches of 1000", "cold, one ray"});
    std::vector<std::string> row;
    for (const Cell& cell : session.cells) {
        if (cell.section != "linear_scan") continue;
        if (row.empty()) row = {cell.scene, with_commas(cell.triangles)};
        row.push_back(digits(cell.values.front().value));
        if (row.size() < 6) continue;
        table.add(std::move(row));
        row = {};
    }
    return table.empty() ? std::string() : table.text();
}

} // namespace raywise::bench
