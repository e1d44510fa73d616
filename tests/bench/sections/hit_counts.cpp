// How many of a few rays hit, for ours and for Embree: not timed. A fast answer that is wrong should not pass for a fast answer.
#include "bench/sections/section.h"
#include "bench/table.h"

#include "rays/rays.h"

#include <algorithm>

namespace raywise::bench {
namespace {

constexpr std::uint64_t rays_asked = 5000;

// Peers round at edges, and lose rays there: more than that is a fault.
std::uint64_t allowed(std::uint64_t rays) { return 2 + rays / 1000; }

const Subject* reference(const Session& session) {
    const auto find = [&](bool robust) {
        return std::find_if(session.subjects.begin(), session.subjects.end(), [&](const auto& subject) {
            return subject->traits().peer && !subject->traits().slow && (subject->traits().robust || !robust);
        });
    };
    for (const bool robust : {true, false}) {
        const auto found = find(robust);
        if (found != session.subjects.end()) return found->get();
    }
    return nullptr;
}

Value count_hits(SceneUnderTest& scene, const Subject& subject, std::size_t kind, Question question,
                 const RaySet& rays) {
    QueryRequest request{rays};
    request.question = question;
    Value value;
    value.subject = subject.name();
    value.peer = subject.traits().peer;
    value.robust = subject.traits().robust;
    value.value = static_cast<double>(scene.built(subject, kind).query(request)->ask(0, rays.size()));
    value.hit_rate = value.value / static_cast<double>(rays.size());
    value.instruction_set = subject.traits().instruction_set;
    value.repetitions = 1;
    return value;
}

} // namespace

void measure_hit_counts(SceneUnderTest& scene) {
    Session& session = scene.session();
    const Subject* const peer = reference(session);
    if (peer == nullptr) return;
    const Subject& ours = *session.subjects.front();
    for (std::size_t kind = 0; kind < workloads::ray_distributions().size(); ++kind) {
        const workloads::RayDistribution& distribution = workloads::ray_distributions()[kind];
        const Question question = distribution.any_hit ? Question::any : Question::closest;
        if (!session.wants_rays(distribution.name) || !session.wants_query(question) || !scene.has_rays(kind)) continue;
        const RaySet rays = scene.rays(kind, rays_asked);
        if (rays.size() == 0) continue;
        Cell cell = scene.cell("hit_counts", distribution.name, question);
        cell.count = rays.size();
        cell.unit = "hits";
        cell.values = {count_hits(scene, ours, kind, question, rays), count_hits(scene, *peer, kind, question, rays)};
        const double difference = cell.values.front().value - cell.values.back().value;
        if (std::abs(difference) > static_cast<double>(allowed(rays.size()))) {
            session.failed = true;
            session.warnings.push_back(scene.name() + ", hit_counts, " + distribution.name + ": " + ours.name() + " " +
                                       digits(cell.values.front().value) + ", " + peer->name() + " " +
                                       digits(cell.values.back().value) + " of " + with_commas(rays.size()) + " rays");
        }
        session.cells.push_back(std::move(cell));
    }
}

std::string hit_counts_table(const Session& session) {
    Table table("Hits, counted: a check, not timed", {"scene", "rays", "query", "asked", "bvh", "peer", ""});
    for (const Cell& cell : session.cells) {
        if (cell.section != "hit_counts") continue;
        table.add({cell.scene, cell.rays, cell.query, with_commas(cell.count), digits(cell.values.front().value),
                   digits(cell.values.back().value), cell.values.back().subject});
    }
    return table.empty() ? std::string() : table.text();
}

} // namespace raywise::bench
