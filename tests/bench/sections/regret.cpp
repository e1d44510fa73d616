// What the choice costs: from cold to R answers with the structure that raywise chooses, choosing included, beside each structure it could
// have chosen, all in one thread and one run. Regret is how much longer it takes than the best of them.
//
// A structure is timed only where it may be the best, by what it took when each was looked at once: a kd-tree for ten rays would take the
// whole run.
#include "bench/report.h"
#include "bench/sections/from_cold.h"
#include "bench/sections/section.h"
#include "bench/subjects/raywise_subject.h"
#include "bench/table.h"

#include "base/structure.h"
#include "model/cost_units.h"
#include "model/machine.h"
#include "rays/rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raywise::bench {
namespace {

constexpr const char* section = "regret";
constexpr std::uint64_t most_rays = 100'000'000;

// So many times the best expected total a structure may be expected to take and is timed all the same: grids are made otherwise for few rays
// than for many, at half or a third of the cost.
constexpr double worth_timing = 4.0;

// With so many rays each is looked at: what a batch costs whatever its rays would count among fewer, and a scan of all triangles takes long
// enough for these.
constexpr std::uint64_t rays_of_look = 10'000;

// Somebody who may answer, and what he was found to take.
struct Contender {
    const Subject* subject;
    double build_ns = 0.0;
    double ns_per_ray = 0.0;
    std::vector<double> ms; // of this decade

    double expected_ms(std::uint64_t count) const {
        return (build_ns + ns_per_ray * static_cast<double>(count)) * 1e-6;
    }
};

class Decision {
public:
    Decision(SceneUnderTest& scene, std::size_t kind)
        : scene_(scene),
          distribution_(workloads::ray_distributions()[kind]),
          rays_(scene, kind, decades_up_to(most_rays)) {
        const Library& library = scene.session().library;
        const auto add = [&](const char* name, const char* structure) {
            subjects_.push_back(raywise_subject({name, structure, this_machine().instruction_set}, library));
            contenders_.push_back({subjects_.back().get(), 0.0, 0.0, {}});
        };
        add(ours_chosen, nullptr);
        for (const Structure structure : all_structures()) {
            if (!needs_view(structure)) add(name_of(structure), name_of(structure));
        }
    }

    void run() {
        if (!rays_.are_there()) return;
        for (Contender& contender : contenders_) {
            scene_.session().show_progress("looking at " + contender.subject->name() + ", " + distribution_.name +
                                           " rays");
            const ColdTime time = time_from_cold(*contender.subject, rays_, rays_of_look);
            contender.build_ns = time.build_ns;
            contender.ns_per_ray = time.ns_per_ray;
        }
        for (const std::uint64_t count : decades_up_to(most_rays)) time_decade(count);
    }

private:
    std::vector<Contender*> worth_timing_for(std::uint64_t count) {
        double least = std::numeric_limits<double>::infinity();
        for (const Contender& contender : contenders_) least = std::min(least, contender.expected_ms(count));
        std::vector<Contender*> those;
        for (Contender& contender : contenders_) {
            if (contender.subject->traits().chooses || contender.expected_ms(count) <= worth_timing * least)
                those.push_back(&contender);
        }
        return those;
    }

    void time_decade(std::uint64_t count) {
        const Session& session = scene_.session();
        const std::vector<Contender*> those = worth_timing_for(count);
        for (Contender* contender : those) contender->ms.clear();
        std::string chosen;
        for (unsigned repetition = 0; repetition < session.options.repetitions; ++repetition) {
            session.show_progress("choosing for " + power_of_ten(count) + ' ' + distribution_.name + " rays, " +
                                  std::to_string(repetition + 1) + " of " +
                                  std::to_string(session.options.repetitions));
            for (std::size_t turn = 0; turn < those.size(); ++turn) {
                Contender& contender = *those[(turn + repetition) % those.size()];
                const ColdTime time = time_from_cold(*contender.subject, rays_, count);
                contender.ms.push_back(time.total_ms(count));
                if (contender.subject->traits().chooses) chosen = time.structure;
            }
        }
        Cell cell = scene_.cell(section, distribution_.name, rays_.question());
        cell.count = count;
        cell.unit = "ms";
        cell.higher_is_better = false;
        for (const Contender* contender : those) {
            Value value = value_of_times(contender->ms);
            value.subject = contender->subject->name();
            value.structure = contender->subject->traits().chooses ? chosen : contender->subject->name();
            value.extrapolated = count > rays_.most();
            cell.values.push_back(std::move(value));
        }
        scene_.session().cells.push_back(std::move(cell));
    }

    SceneUnderTest& scene_;
    const workloads::RayDistribution& distribution_;
    ColdRays rays_;
    Subjects subjects_;
    std::vector<Contender> contenders_;
};

const Value& best_of(const Cell& cell) {
    return *std::min_element(cell.values.begin(), cell.values.end(),
                             [](const Value& a, const Value& b) { return a.value < b.value; });
}

double regret_of(const Cell& cell) { return cell.of(ours_chosen)->value / best_of(cell).value - 1.0; }

// "12 morton": percent, and which would have been that much quicker, where another would have been by more than noise.
std::string text_of(const Cell& cell) {
    const double percent = 100.0 * regret_of(cell);
    std::string text = std::to_string(std::lround(percent));
    if (percent >= 10.0) text += ' ' + short_name(best_of(cell).structure);
    return text;
}

} // namespace

void measure_regret(SceneUnderTest& scene) {
    const Session& session = scene.session();
    const auto& kinds = workloads::ray_distributions();
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        const Question question = kinds[kind].any_hit ? Question::any : Question::closest;
        if (session.wants_rays(kinds[kind].name) && session.wants_query(question) && scene.has_rays(kind))
            Decision(scene, kind).run();
    }
}

nlohmann::ordered_json regret_summary(const Session& session) {
    std::vector<double> all;
    double worst = 0.0;
    std::string where;
    for (const Cell& cell : session.cells) {
        if (cell.section != section) continue;
        all.push_back(regret_of(cell));
        if (all.size() > 1 && all.back() <= worst) continue;
        worst = all.back();
        where = cell.scene + ", " + cell.rays + ", " + power_of_ten(cell.count);
    }
    if (all.empty()) return nullptr;
    return {{"cells", all.size()},
            {"median", calibration::median(all)},
            {"percentile_95", calibration::quantile(all, 0.95)},
            {"worst", worst},
            {"worst_where", where}};
}

std::string regret_table(const Session& session) {
    std::string text;
    for (const workloads::RayDistribution& distribution : workloads::ray_distributions()) {
        std::vector<std::string> headings = {"scene"};
        for (const std::uint64_t count : decades_up_to(most_rays)) headings.push_back(power_of_ten(count));
        Table table(std::string("Regret of the choice, 1 thread, ") + distribution.name +
                        " rays: by how many percent the total is above that of\nthe best structure, and which that "
                        "is where it is 10 % or more",
                    headings);
        std::vector<std::string> row;
        for (const Cell& cell : session.cells) {
            if (cell.section != section || cell.rays != distribution.name) continue;
            if (row.empty()) row = {cell.scene};
            row.push_back(text_of(cell));
            if (row.size() < headings.size()) continue;
            table.add(std::move(row));
            row = {};
        }
        if (!table.empty()) text += table.text();
    }
    const nlohmann::ordered_json summary = regret_summary(session);
    if (summary.is_null()) return text;
    const auto percent = [&](const char* key) { return digits(100.0 * summary[key].get<double>()) + " %"; };
    return text + "Regret: median " + percent("median") + ", 95th percentile " + percent("percentile_95") + ", worst " +
           percent("worst") + " (" + summary["worst_where"].get<std::string>() + ")\n\n";
}

} // namespace raywise::bench
