// What a call costs: rays that miss the box around the scene, so that next to nothing else is done. The batch call does the same
// for each ray without crossing the interface; what single calls take longer is the price of the call.
#include "bench/sections/section.h"
#include "bench/subjects/yardstick_subject.h"
#include "bench/table.h"

#include "rays/rays.h"

namespace raywise::bench {
namespace {

constexpr std::size_t count = 10000;

// From beside the scene, away from it.
RaySet rays_that_miss(const workloads::Mesh& mesh) {
    const workloads::Sphere sphere = workloads::bounding_sphere(mesh);
    const Vec3 out = Vec3(0.6, 0.64, 0.48); // unit length
    workloads::Rays rays;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 aside = Vec3(0.0, 0.6, -0.8) * (0.001 * static_cast<double>(i % 100));
        rays.add(sphere.centre + out * (2.0 * sphere.radius), out + aside, 0.0, 1e30);
    }
    return rounded(rays);
}

} // namespace

void measure_overhead(SceneUnderTest& scene) {
    Session& session = scene.session();
    if (scene.name() != "box") return;
    const RaySet rays = rays_that_miss(scene.mesh());
    for (const Question question : {Question::closest, Question::any}) {
        if (!session.wants_query(question)) continue;
        Cell cell = scene.cell("overhead", "missing the box", question);
        cell.count = rays.size();
        std::vector<Entry> entries;
        Answers answers;
        const auto add = [&](const Subject& subject, Call call) {
            if (!subject.has(call)) return;
            QueryRequest request{rays};
            request.question = question;
            request.call = call;
            if (call == Call::batch) request.answers = &answers;
            entries.push_back({&subject,
                               subject.name() + (call == Call::batch ? ", batch" : ""),
                               scene.built(subject, 0).query(request),
                               rays.size(),
                               {}});
        };
        for (const auto& subject : session.subjects) {
            if (subject->traits().slow || subject->traits().chooses) continue;
            add(*subject, Call::single);
            add(*subject, Call::batch);
        }
        for (const auto& subject : session.yardstick) add(*subject, Call::single);
        time_rays(scene, cell, entries, session.effort.timing);
        cell.unit = "ns/ray";
        cell.higher_is_better = false;
        for (Value& value : cell.values) value.value = 1e3 / value.value;
        session.cells.push_back(std::move(cell));
    }
}

std::string overhead_table(const Session& session) {
    Table table(
        "One call, 1 thread, rays that miss the scene's box: ns per ray",
        {"query", "bvh, single", "bvh, batch", "difference", "best peer, single", "", "bvh beyond it", "yardstick"});
    for (const Cell& cell : session.cells) {
        if (cell.section != "overhead") continue;
        const Value* const single = cell.of(ours_forced);
        const Value* const batch = cell.of(std::string(ours_forced) + ", batch");
        const Value* const peer = cell.best_peer();
        const Value* const yardstick = cell.of(yardstick_name);
        if (single == nullptr || batch == nullptr) continue;
        table.add({cell.query, digits(single->value), digits(batch->value), digits(single->value - batch->value),
                   peer != nullptr ? digits(peer->value) : "", peer != nullptr ? peer->subject : "",
                   peer != nullptr ? digits(single->value - peer->value) : "",
                   yardstick != nullptr ? digits(yardstick->value) : ""});
    }
    return table.empty() ? std::string() : table.text();
}

} // namespace raywise::bench
