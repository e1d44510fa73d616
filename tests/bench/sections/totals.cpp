// From cold to R answers, building included, in one thread. raywise is told R and chooses; it answers by one batch call. The others
// build once and ask ray after ray. What would take too long is reckoned from the rate of the rays that were asked, and marked.
#include "bench/sections/section.h"
#include "bench/table.h"

#include "rays/rays.h"

#include <algorithm>
#include <cmath>

namespace raywise::bench {
namespace {

constexpr std::uint64_t decades[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000};

// Milliseconds for each decade, and how they came about.
struct Totals {
    const Subject* subject;
    std::vector<std::vector<double>> ms = std::vector<std::vector<double>>(std::size(decades));
    std::vector<std::string> structure = std::vector<std::string>(std::size(decades));
};

class Race {
public:
    Race(SceneUnderTest& scene, std::size_t kind)
        : scene_(scene), kind_(kind), distribution_(workloads::ray_distributions()[kind]) {
        const Session& session = scene.session();
        const std::uint64_t affordable =
            affordable_rays(scene, kind, question(), session.effort.totals_measured, session.effort.totals_ns);
        for (const std::uint64_t decade : decades)
            if (decade <= affordable) most_ = decade;
        rays_ = scene.rays(kind, most_);
        for (const auto& subject : session.subjects)
            if (subject->traits().totals) totals_.push_back({subject.get()});
    }

    void run(unsigned repetitions) {
        if (rays_.size() < most_) return;
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
        for (std::size_t i = 0; i < std::size(decades); ++i) {
            Cell cell = scene_.cell("totals", distribution_.name, question());
            cell.count = decades[i];
            cell.unit = "ms";
            cell.higher_is_better = false;
            for (const Totals& totals : totals_) {
                Value value;
                value.subject = totals.subject->name();
                value.peer = totals.subject->traits().peer;
                value.value = calibration::median(totals.ms[i]);
                value.repetitions = static_cast<unsigned>(totals.ms[i].size());
                value.spread = (calibration::quantile(totals.ms[i], 0.75) - calibration::quantile(totals.ms[i], 0.25)) /
                               value.value;
                value.structure = totals.structure[i];
                value.extrapolated = decades[i] > most_;
                cell.values.push_back(std::move(value));
            }
            scene_.session().cells.push_back(std::move(cell));
        }
    }

private:
    Question question() const { return distribution_.any_hit ? Question::any : Question::closest; }

    BuildRequest request(std::uint64_t count) const {
        BuildRequest request{scene_.mesh()};
        request.kind = kind_;
        request.count = count;
        return request;
    }

    // The rays are the caller's: laying them out is not counted.
    std::unique_ptr<Query> query(const Built& built, Call call) const {
        QueryRequest request{rays_};
        request.question = question();
        request.call = call;
        return built.query(request);
    }

    void build_for_each(Totals& totals) const {
        for (std::size_t i = 0; i < std::size(decades); ++i) {
            const std::uint64_t asked = std::min(decades[i], most_);
            const double start = calibration::processor_ns();
            const std::unique_ptr<Built> built = totals.subject->build(request(decades[i]));
            const double build_ns = calibration::processor_ns() - start;
            const std::unique_ptr<Query> rays = query(*built, Call::batch);
            const double begin = calibration::processor_ns();
            rays->ask(0, asked);
            const double asked_ns = calibration::processor_ns() - begin;
            const double rays_ns = asked_ns * static_cast<double>(decades[i]) / static_cast<double>(asked);
            totals.ms[i].push_back((build_ns + rays_ns) * 1e-6);
            totals.structure[i] = built->structure();
        }
    }

    void build_once(Totals& totals) const {
        const double start = calibration::processor_ns();
        const std::unique_ptr<Built> built = totals.subject->build(request(most_));
        double ns = calibration::processor_ns() - start;
        const std::unique_ptr<Query> rays = query(*built, Call::single);
        std::uint64_t done = 0;
        double ns_per_ray = 0.0; // of the latest decade
        for (std::size_t i = 0; i < std::size(decades); ++i) {
            const std::uint64_t more = decades[i] - done;
            if (decades[i] <= most_) {
                const double begin = calibration::processor_ns();
                rays->ask(done, decades[i]);
                const double asked_ns = calibration::processor_ns() - begin;
                ns_per_ray = asked_ns / static_cast<double>(more);
                ns += asked_ns;
            } else {
                ns += ns_per_ray * static_cast<double>(more);
            }
            done = decades[i];
            totals.ms[i].push_back(ns * 1e-6);
        }
    }

    SceneUnderTest& scene_;
    std::size_t kind_;
    const workloads::RayDistribution& distribution_;
    std::uint64_t most_ = 1; // rays that are asked
    RaySet rays_;
    std::vector<Totals> totals_;
};

std::string power_of_ten(std::uint64_t count) {
    return count < 1000 ? std::to_string(count)
                        : "1e" + std::to_string(std::lround(std::log10(static_cast<double>(count))));
}

// What fits into a narrow column.
std::string short_name(const std::string& structure) {
    const std::size_t underscore = structure.find('_');
    if (underscore == std::string::npos) return structure;
    const std::string last = structure.substr(underscore + 1);
    return last == "tree" ? structure.substr(0, underscore) : last == "bvh" ? "proj" : last;
}

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
        for (const std::uint64_t count : decades) headings.push_back(power_of_ten(count));
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
