#include "bench/summary.h"

#include "bench/report.h"
#include "bench/table.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace raywise::bench {
namespace {

// Which cells one figure of the summary is taken from, and who is compared in them.
struct Figure {
    const char* key;
    const char* section;
    std::vector<const char*> rays; // empty: all
    const char* query;             // nullptr: all
    const char* ours;
    const char* peer; // beginning of its name after "Embree 3 "; nullptr: the best of all
    bool robust;      // among peers that ask for watertight tests only
    unsigned threads; // 0: all there are
};

const std::vector<Figure>& figures() {
    static const std::vector<Figure> all = {
        {"single_closest", "single", {"random", "diffuse"}, "closest", ours_forced, nullptr, false, 1},
        {"single_any", "single", {"shadow"}, "any", ours_forced, nullptr, false, 1},
        {"single_camera", "single", {"camera"}, "closest", ours_forced, nullptr, false, 1},
        {"single_vs_robust", "single", {"random", "diffuse", "shadow"}, nullptr, ours_forced, nullptr, true, 1},
        {"single_chosen", "single", {"random", "diffuse", "shadow"}, nullptr, ours_chosen, nullptr, false, 1},
        {"build_fast", "build", {}, nullptr, ours_forced, "MEDIUM", false, 1},
        {"build_quality", "build", {}, nullptr, ours_quality, "HIGH", false, 1},
    };
    return all;
}

nlohmann::ordered_json ratios(const Session& session, const Figure& figure) {
    Ratios ratios;
    for (const Cell& cell : session.cells) {
        if (cell.section != figure.section || (figure.threads != 0 && cell.threads != figure.threads)) continue;
        if (figure.query != nullptr && cell.query != figure.query) continue;
        if (!figure.rays.empty() && std::find(figure.rays.begin(), figure.rays.end(), cell.rays) == figure.rays.end())
            continue;
        const Value* const ours = cell.of(figure.ours);
        const Value* const peer =
            figure.peer != nullptr ? cell.of(std::string("Embree 3 ") + figure.peer)
                                   : cell.best_peer([&](const Value& value) { return value.robust || !figure.robust; });
        if (ours == nullptr || peer == nullptr) continue;
        ratios.add(cell.ratio(*ours, *peer), cell.rays.empty() ? cell.scene : cell.scene + ", " + cell.rays);
    }
    return ratios.empty() ? nlohmann::ordered_json(nullptr) : ratios.json();
}

} // namespace

nlohmann::ordered_json summary_of(const Session& session) {
    nlohmann::ordered_json summary;
    for (const Figure& figure : figures()) summary[figure.key] = ratios(session, figure);
    return summary;
}

std::string summary_text(const nlohmann::ordered_json& summary) {
    Table table("Summary: ours over the best peer, above 1 is better", {"", "geometric mean", "worst", "where"});
    for (const auto& [key, value] : summary.items()) {
        if (!value.is_object() || !value.contains("geomean")) continue;
        table.add({key, ratio_text(value["geomean"]), ratio_text(value["worst"]), value["worst_scene"]});
    }
    return table.empty() ? std::string() : table.text();
}

} // namespace raywise::bench
