// Many rays at once: our batch calls beside what a program does with a library that has none: a loop over single calls, or over
// packets of eight where rays come in the order of an image. All write t, u, v and the primitive, or a flag, for each ray.
#include "bench/sections/section.h"
#include "bench/table.h"

#include "rays/rays.h"

#include <cstring>

namespace raywise::bench {
namespace {

constexpr std::uint64_t order_seed = 3;
constexpr const char* shuffled_suffix = ", shuffled";

// From one point or towards one, as they come from an image: packets are of use.
bool is_coherent(const std::string& kind) { return kind == "camera" || kind == "shadow"; }

struct Rays {
    std::size_t kind;
    Question question;
    RaySet in_image_order;
    RaySet in_random_order;
};

// "Embree 4 HIGH packet8" as "E4 HIGH p8", so that the table fits.
std::string abbreviated(std::string subject) {
    constexpr struct {
        const char* words;
        const char* instead;
    } abbreviations[] = {{"Embree ", "E"}, {"packet8", "p8"}};
    for (const auto& abbreviation : abbreviations) {
        const std::size_t place = subject.find(abbreviation.words);
        if (place != std::string::npos) subject.replace(place, std::strlen(abbreviation.words), abbreviation.instead);
    }
    return subject;
}

void measure(SceneUnderTest& scene, const Rays& all, unsigned threads) {
    Session& session = scene.session();
    const workloads::RayDistribution& distribution = workloads::ray_distributions()[all.kind];
    const bool coherent = is_coherent(distribution.name);
    session.show_progress(std::string("batches, ") + distribution.name + ", threads: " + std::to_string(threads));
    Cell cell = scene.cell("batch", distribution.name, all.question);
    cell.count = all.in_image_order.size();
    cell.threads = threads;
    Answers answers; // one for all: the same memory, as warm for each
    std::vector<Entry> entries;
    const auto add = [&](const Subject& subject, Call call, const RaySet& rays, const std::string& label) {
        const Built& built = scene.built(subject, all.kind);
        QueryRequest request{rays};
        request.question = all.question;
        request.call = call;
        request.threads = threads;
        request.answers = &answers;
        entries.push_back({&subject, label, built.query(request), rays.size(),
                           subject.traits().peer ? std::string() : built.structure()});
    };
    for (const auto& subject : session.subjects) {
        if (!subject->traits().batches) continue;
        const RaySet& usual = coherent ? all.in_image_order : all.in_random_order;
        if (subject->has(Call::batch)) {
            add(*subject, Call::batch, usual, subject->name());
            if (coherent && !subject->traits().chooses)
                add(*subject, Call::batch, all.in_random_order, subject->name() + shuffled_suffix);
        } else {
            add(*subject, Call::single, usual, subject->name());
            if (coherent && subject->has(Call::packet))
                add(*subject, Call::packet, all.in_image_order, subject->name() + " packet8");
        }
    }
    time_rays(scene, cell, entries, session.effort.timing);
    session.cells.push_back(std::move(cell));
}

} // namespace

void measure_batch(SceneUnderTest& scene) {
    Session& session = scene.session();
    const auto& kinds = workloads::ray_distributions();
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        if (!session.wants_rays(kinds[kind].name)) continue;
        const Question question = kinds[kind].any_hit ? Question::any : Question::closest;
        if (!session.wants_query(question)) continue;
        const std::uint64_t count =
            affordable_rays(scene, kind, question, session.effort.batch_rays, session.effort.batch_pass_ns);
        Rays rays{kind, question, scene.rays(kind, count), {}};
        if (rays.in_image_order.size() == 0) continue;
        rays.in_random_order = shuffled(rays.in_image_order, order_seed);
        measure(scene, rays, 1);
        if (session.all_threads > 1) measure(scene, rays, session.all_threads);
    }
}

std::string batch_table(const Session& session) {
    std::string text;
    for (const workloads::RayDistribution& distribution : workloads::ray_distributions()) {
        const bool coherent = is_coherent(distribution.name);
        Table table(std::string("Batches, ") + distribution.name +
                        (coherent ? " rays in image order (mixed: ours in random order; p8: packets of 8)"
                                  : " rays in random order") +
                        ": Mray/s",
                    {"scene", "rays", "thr", "bvh", coherent ? "mixed" : "", "chosen", "", "best peer", "", "ratio",
                     coherent ? "mixed" : ""});
        for (const Cell& cell : session.cells) {
            if (cell.section != "batch" || cell.rays != distribution.name) continue;
            const Value* const ours = cell.of(ours_forced);
            const Value* const mixed = cell.of(std::string(ours_forced) + shuffled_suffix);
            const Value* const chosen = cell.of(ours_chosen);
            const Value* const peer = cell.best_peer();
            const auto rate = [](const Value* value) { return value != nullptr ? digits(value->value) : ""; };
            const auto over = [&](const Value* value) {
                return value != nullptr && peer != nullptr ? ratio_text(cell.ratio(*value, *peer)) : "";
            };
            table.add({cell.scene, with_commas(cell.count), std::to_string(cell.threads), rate(ours), rate(mixed),
                       rate(chosen), chosen != nullptr ? chosen->structure : "", rate(peer),
                       peer != nullptr ? abbreviated(peer->subject) : "", over(ours), over(mixed)});
        }
        if (!table.empty()) text += table.text();
    }
    return text;
}

} // namespace raywise::bench
