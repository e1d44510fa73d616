// Rays one by one, in one thread: a call for each.
#include "bench/sections/section.h"
#include "bench/subjects/yardstick_subject.h"
#include "bench/table.h"

#include "rays/rays.h"

#include <algorithm>
#include <initializer_list>

namespace raywise::bench {
namespace {

constexpr const char* section = "single";
constexpr const char* avx2_section = "single_avx2"; // the same rays, all told to use AVX2

struct Asked {
    const char* rays;
    Question question;
    bool quick;
};

constexpr Asked questions[] = {
    {"random", Question::closest, true}, {"camera", Question::closest, true}, {"diffuse", Question::closest, true},
    {"shadow", Question::any, true},     {"random", Question::any, false},    {"diffuse", Question::any, false},
};

// A cell of all these subjects.
void measure(SceneUnderTest& scene, std::size_t kind, Question question, const RaySet& rays, const char* cell_section,
             std::initializer_list<const Subjects*> groups) {
    Session& session = scene.session();
    Cell cell = scene.cell(cell_section, workloads::ray_distributions()[kind].name, question);
    cell.count = rays.size();
    std::vector<Entry> entries;
    for (const Subjects* group : groups) {
        for (const auto& subject : *group) {
            if (!subject->has(Call::single) || !session.fits(*subject, scene.triangles())) continue;
            const Built& built = scene.built(*subject, kind);
            const std::size_t stride = subject->traits().slow
                                           ? thinned_by(built, rays, question, 4.0 * session.effort.single_pass_ns)
                                           : std::size_t{1};
            const RaySet fewer = stride > 1 ? one_in(rays, stride) : RaySet();
            QueryRequest request{stride > 1 ? fewer : rays};
            request.question = question;
            entries.push_back({subject.get(), subject->name(), built.query(request), request.rays.size(),
                               subject->traits().peer ? std::string() : built.structure()});
        }
    }
    time_rays(scene, cell, entries, session.effort.timing);
    session.cells.push_back(std::move(cell));
}

void measure(SceneUnderTest& scene, std::size_t kind, Question question) {
    Session& session = scene.session();
    session.show_progress(std::string("single rays, ") + workloads::ray_distributions()[kind].name + ", " +
                          name_of(question));
    const double pass_ns = session.effort.single_pass_ns;
    const RaySet rays = scene.rays(kind, affordable_rays(scene, kind, question, session.effort.single_rays, pass_ns));
    if (rays.size() == 0) return;
    measure(scene, kind, question, rays, section, {&session.subjects, &session.yardstick});
    if (!session.avx2.empty()) measure(scene, kind, question, rays, avx2_section, {&session.avx2});
}

const Cell* find_avx2(const Session& session, const Cell& like) {
    for (const Cell& cell : session.cells) {
        if (cell.section == avx2_section && cell.scene == like.scene && cell.rays == like.rays &&
            cell.query == like.query)
            return &cell;
    }
    return nullptr;
}

std::string ratio_to_best(const Cell& cell, const char* subject) {
    const Value* const value = cell.of(subject);
    const Value* const peer = cell.best_peer();
    return value != nullptr && peer != nullptr ? ratio_text(cell.ratio(*value, *peer)) : std::string();
}

} // namespace

void measure_single(SceneUnderTest& scene) {
    const auto& kinds = workloads::ray_distributions();
    for (const Asked& asked : questions) {
        if (scene.session().options.quick && !asked.quick) continue;
        if (!scene.session().wants_rays(asked.rays) || !scene.session().wants_query(asked.question)) continue;
        const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                       [&](const auto& other) { return std::string(other.name) == asked.rays; });
        const auto place = static_cast<std::size_t>(kind - kinds.begin());
        if (scene.has_rays(place)) measure(scene, place, asked.question);
    }
    scene.release(scene.session().avx2); // nobody else asks for them
}

std::string single_table(const Session& session) {
    std::string text;
    for (const Asked& asked : questions) {
        Table table(
            std::string("Single calls, 1 thread, ") + asked.rays + " rays, " + name_of(asked.question) + " hit: Mray/s",
            {"scene", "triangles", "bvh", "isa", "chosen", "", "best peer", "", "ratio", "robust", "AVX2", "yardstick",
             "AVX2", "bvh_quality", "E3 HIGH", "bvh_morton", "over bvh"});
        for (const Cell& cell : session.cells) {
            if (cell.section != section || cell.rays != asked.rays || cell.query != name_of(asked.question)) continue;
            const Value* const ours = cell.of(ours_forced);
            const Value* const morton = cell.of(ours_morton);
            const Value* const chosen = cell.of(ours_chosen);
            const Value* const peer = cell.best_peer();
            const auto speed = [&](const char* subject) {
                const Value* const value = cell.of(subject);
                return value != nullptr ? digits(value->value) : "";
            };
            const Value* const robust = cell.best_peer([](const Value& value) { return value.robust; });
            if (ours == nullptr) continue;
            const Cell* const avx2 = find_avx2(session, cell);
            table.add({cell.scene, with_commas(cell.triangles), digits(ours->value), ours->instruction_set,
                       chosen != nullptr ? digits(chosen->value) : "", chosen != nullptr ? chosen->structure : "",
                       peer != nullptr ? digits(peer->value) : "", peer != nullptr ? peer->subject : "",
                       peer != nullptr ? ratio_text(cell.ratio(*ours, *peer)) : "",
                       robust != nullptr ? ratio_text(cell.ratio(*ours, *robust)) : "",
                       avx2 != nullptr ? ratio_to_best(*avx2, ours_forced) : "", ratio_to_best(cell, yardstick_name),
                       avx2 != nullptr ? ratio_to_best(*avx2, yardstick_name) : "", speed(ours_quality),
                       speed("Embree 3 HIGH"), speed(ours_morton),
                       morton != nullptr ? ratio_text(cell.ratio(*morton, *ours)) : ""});
        }
        if (!table.empty()) text += table.text();
    }
    return text;
}

} // namespace raywise::bench
