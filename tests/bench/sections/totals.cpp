// From cold to R answers, building included, in one thread. raywise is told R and chooses; it answers by one batch call. The others
// build once and ask ray after ray. What would take too long is reckoned from the rate of the rays that were asked, and marked.
#include "bench/sections/from_cold.h"
#include "bench/sections/section.h"
#include "bench/table.h"

#include "rays/rays.h"

#include <algorithm>

namespace raywise::bench {
namespace {

const std::vector<std::uint64_t>& decades() {
    static const std::vector<std::uint64_t> all = decades_up_to(10'000'000);
    return all;
}

// Milliseconds for each decade, and how they came about.
struct Totals {
    const Subject* subject;
    std::vector<std::vector<double>> ms = std::vector<std::vector<double>>(decades().size());
    std::vector<std::string> structure = std::vector<std::string>(decades().size());
};

class Race {
public:
    Race(SceneUnderTest& scene, std::size_t kind)
        : scene_(scene), distribution_(workloads::ray_distributions()[kind]), rays_(scene, kind, decades()) {
        for (const auto& subject : scene.session().subjects)
            if (subject->traits().totals) totals_.push_back({subject.get()});
    }

    void run(unsigned repetitions) {
        if (!rays_.are_there()) return;
        for (unsigned repetition = 0; repetition < repetitions; ++repetition) {
            scene_.session().show_progress("from cold, " + std::to_string(repetition + 1) + " of " +
                                           std::to_string(repetitions));
            for (std::size_t turn = 0; turn < totals_.size(); ++turn) {
                Totals& totals = totals_[(turn + repetition) % totals_.size()];
                if (totals.subject->traits().chooses)
                    build_for_each(totals);
                else
                    build_once(totals);
            }
        }
        for (std::size_t i = 0; i < decades().size(); ++i) {
            Cell cell = scene_.cell("totals", distribution_.name, rays_.question());
            cell.count = decades()[i];
            cell.unit = "ms";
            cell.higher_is_better = false;
            for (const Totals& totals : totals_) {
                Value value = value_of_times(totals.ms[i]);
                value.subject = totals.subject->name();
                value.peer = totals.subject->traits().peer;
                value.structure = totals.structure[i];
                value.extrapolated = decades()[i] > rays_.most();
                cell.values.push_back(std::move(value));
            }
            scene_.session().cells.push_back(std::move(cell));
        }
    }

private:
    void build_for_each(Totals& totals) const {
        for (std::size_t i = 0; i < decades().size(); ++i) {
            const ColdTime time = time_from_cold(*totals.subject, rays_, decades()[i]);
            totals.ms[i].push_back(time.total_ms(decades()[i]));
            totals.structure[i] = time.structure;
        }
    }

    void build_once(Totals& totals) const {
        const double start = calibration::processor_ns();
        const std::unique_ptr<Built> built = totals.subject->build(rays_.request(rays_.most()));
        double ns = calibration::processor_ns() - start;
        QueryRequest request{rays_.rays()};
        request.question = rays_.question();
        const std::unique_ptr<Query> rays = built->query(request);
        std::uint64_t done = 0;
        double ns_per_ray = 0.0; // of the latest decade
        for (std::size_t i = 0; i < decades().size(); ++i) {
            const std::uint64_t more = decades()[i] - done;
            if (decades()[i] <= rays_.most()) {
                const double begin = calibration::processor_ns();
                rays->ask(done, decades()[i]);
                const double asked_ns = calibration::processor_ns() - begin;
                ns_per_ray = asked_ns / static_cast<double>(more);
                ns += asked_ns;
            } else {
                ns += ns_per_ray * static_cast<double>(more);
            }
            done = decades()[i];
            totals.ms[i].push_back(ns * 1e-6);
        }
    }

    SceneUnderTest& scene_;
    const workloads::RayDistribution& distribution_;
    ColdRays rays_;
    std::vector<Totals> totals_;
};

} // namespace

void measure_totals(SceneUnderTest& scene) {
    Session& session = scene.session();
    const auto& kinds = workloads::ray_distributions();
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        // Random rays, unless others are asked for by name.
        if (session.options.rays.empty() ? kind != 0 : !session.wants_rays(kinds[kind].name)) continue;
        if (!session.wants_query(kinds[kind].any_hit ? Question::any : Question::closest)) continue;
        Race(scene, kind).run(session.options.repetitions);
    }
}

std::string totals_table(const Session& session) {
    std::string text;
    for (const workloads::RayDistribution& distribution : workloads::ray_distributions()) {
        std::vector<std::string> headings = {"scene"};
        for (const std::uint64_t count : decades()) headings.push_back(power_of_ten(count));
        Table table(std::string("From cold to R answers, building included, 1 thread, ") + distribution.name +
                        " rays: best peer's time\nover raywise's, and what it chose (*: reckoned from a measured rate)",
                    headings);
        std::vector<std::string> row;
        for (const Cell& cell : session.cells) {
            if (cell.section != "totals" || cell.rays != distribution.name) continue;
            if (row.empty()) row = {cell.scene};
            const Value* const ours = cell.of(ours_chosen);
            const Value* const peer = cell.best_peer();
            row.push_back(ours == nullptr || peer == nullptr
                              ? std::string("-")
                              : ratio_text(cell.ratio(*ours, *peer)) + (ours->extrapolated ? "*" : "") + " " +
                                    short_name(ours->structure));
            if (row.size() < headings.size()) continue;
            table.add(std::move(row));
            row = {};
        }
        if (!table.empty()) text += table.text();
    }
    return text;
}

} // namespace raywise::bench
