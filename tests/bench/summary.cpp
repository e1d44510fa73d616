#include "bench/summary.h"

#include "bench/report.h"
#include "bench/sections/section.h"
#include "bench/subjects/yardstick_subject.h"
#include "bench/table.h"

#include <algorithm>
#include <map>
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
    const char* peer; // nullptr: the best of all
    bool robust;      // among peers that ask for watertight tests only
    unsigned threads; // 1, or 0: all there are
};

const std::vector<Figure>& figures() {
    static const std::vector<Figure> all = {
        {"single_closest", "single", {"random", "diffuse"}, "closest", ours_forced, nullptr, false, 1},
        {"single_any", "single", {"shadow"}, "any", ours_forced, nullptr, false, 1},
        {"single_camera", "single", {"camera"}, "closest", ours_forced, nullptr, false, 1},
        {"single_vs_robust", "single", {"random", "diffuse", "shadow"}, nullptr, ours_forced, nullptr, true, 1},
        {"single_chosen", "single", {"random", "diffuse", "shadow"}, nullptr, ours_chosen, nullptr, false, 1},
        {"single_avx2", "single_avx2", {}, nullptr, ours_forced, nullptr, false, 1},
        {"yardstick", "single", {}, nullptr, yardstick_name, nullptr, false, 1},
        {"yardstick_avx2", "single_avx2", {}, nullptr, yardstick_name, nullptr, false, 1},
        {"batch_incoherent", "batch", {"random", "diffuse"}, nullptr, ours_forced, nullptr, false, 1},
        {"batch_coherent", "batch", {"camera", "shadow"}, nullptr, ours_forced, nullptr, false, 1},
        {"batch_coherent_shuffled", "batch", {"camera", "shadow"}, nullptr, "raywise bvh, shuffled", nullptr, false, 1},
        {"batch_incoherent_threads", "batch", {"random", "diffuse"}, nullptr, ours_forced, nullptr, false, 0},
        {"batch_coherent_threads", "batch", {"camera", "shadow"}, nullptr, ours_forced, nullptr, false, 0},
        {"build_fast", "build", {}, nullptr, ours_forced, "Embree 3 MEDIUM", false, 1},
        {"build_quality", "build", {}, nullptr, ours_quality, "Embree 3 HIGH", false, 1},
        {"morton_build", "build", {}, nullptr, ours_morton, "Embree 3 LOW", false, 1},
        {"morton_rays", "single", {}, nullptr, ours_morton, ours_forced, false, 1},
        {"build_fast_threads", "build", {}, nullptr, ours_forced, "Embree 3 MEDIUM", false, 0},
    };
    return all;
}

nlohmann::ordered_json ratios(const Session& session, const Figure& figure) {
    Ratios ratios;
    for (const Cell& cell : session.cells) {
        if (cell.section != figure.section || (figure.threads == 1) != (cell.threads == 1)) continue;
        if (figure.query != nullptr && cell.query != figure.query) continue;
        if (!figure.rays.empty() && std::find(figure.rays.begin(), figure.rays.end(), cell.rays) == figure.rays.end())
            continue;
        const Value* const ours = cell.of(figure.ours);
        const Value* const peer =
            figure.peer != nullptr ? cell.of(figure.peer)
                                   : cell.best_peer([&](const Value& value) { return value.robust || !figure.robust; });
        if (ours == nullptr || peer == nullptr) continue;
        ratios.add(cell.ratio(*ours, *peer), cell.rays.empty() ? cell.scene : cell.scene + ", " + cell.rays);
    }
    return ratios.empty() ? nlohmann::ordered_json(nullptr) : ratios.json();
}

// One thread's time over that of all.
nlohmann::ordered_json build_scaling(const Session& session) {
    Ratios ratios;
    for (const Cell& one : session.cells) {
        if (one.section != "build" || one.threads != 1) continue;
        for (const Cell& all : session.cells) {
            if (all.section != "build" || all.threads == 1 || all.scene != one.scene) continue;
            const Value* const slow = one.of(ours_forced);
            const Value* const fast = all.of(ours_forced);
            if (slow != nullptr && fast != nullptr) ratios.add(slow->value / fast->value, one.scene);
        }
    }
    return ratios.empty() ? nlohmann::ordered_json(nullptr) : ratios.json();
}

// Ours, over all scenes; by its own account where it gives one, which knows no pages.
nlohmann::ordered_json bytes(const Session& session, const char* query) {
    double sum = 0.0, most = 0.0;
    std::size_t count = 0;
    std::string scene;
    for (const Cell& cell : session.cells) {
        const Value* const ours = cell.of(ours_forced);
        if (cell.section != "memory" || cell.query != query || ours == nullptr) continue;
        const double value = ours->told >= 0.0 ? ours->told : ours->value;
        if (value > most) {
            most = value;
            scene = cell.scene;
        }
        sum += value;
        ++count;
    }
    if (count == 0) return nullptr;
    return {{"mean", sum / static_cast<double>(count)}, {"worst", most}, {"worst_scene", scene}};
}

nlohmann::ordered_json totals(const Session& session) {
    std::map<std::uint64_t, Ratios> ratios;
    for (const Cell& cell : session.cells) {
        const Value* const ours = cell.of(ours_chosen);
        const Value* const peer = cell.best_peer();
        if (cell.section != "totals" || ours == nullptr || peer == nullptr) continue;
        ratios[cell.count].add(cell.ratio(*ours, *peer), cell.scene);
    }
    nlohmann::ordered_json by_count = nlohmann::ordered_json::object();
    for (const auto& [count, found] : ratios) by_count[std::to_string(count)] = found.json();
    return by_count;
}

// The slowest scene of each way to ask, in ns per triangle and ray.
nlohmann::ordered_json linear_scan(const Session& session) {
    nlohmann::ordered_json by_query = nlohmann::ordered_json::object();
    for (const Cell& cell : session.cells) {
        if (cell.section != "linear_scan") continue;
        nlohmann::ordered_json& found = by_query[cell.query];
        if (found.is_null() || found["worst"] < cell.values.front().value)
            found = {{"worst", cell.values.front().value}, {"worst_scene", cell.scene}};
    }
    return by_query;
}

// What a ray that misses the box costs, in ns, and how much of that Embree does without.
nlohmann::ordered_json overhead(const Session& session) {
    nlohmann::ordered_json by_query = nlohmann::ordered_json::object();
    for (const Cell& cell : session.cells) {
        const Value* const ours = cell.of(ours_forced);
        const Value* const peer = cell.best_peer();
        if (cell.section != "overhead" || ours == nullptr || peer == nullptr) continue;
        by_query[cell.query] = {{"ours", ours->value},
                                {"best_peer", peer->value},
                                {"peer", peer->subject},
                                {"beyond", ours->value - peer->value}};
    }
    return by_query;
}

} // namespace

nlohmann::ordered_json summary_of(const Session& session) {
    nlohmann::ordered_json summary;
    for (const Figure& figure : figures()) summary[figure.key] = ratios(session, figure);
    summary["build_scaling"] = build_scaling(session);
    summary["bytes_per_triangle"] = {{"steady", bytes(session, "steady")}, {"peak", bytes(session, "peak")}};
    summary["totals"] = totals(session);
    summary["regret"] = regret_summary(session);
    summary["overhead"] = overhead(session);
    summary["linear_scan"] = linear_scan(session);
    return summary;
}

std::string summary_text(const nlohmann::ordered_json& summary) {
    Table table("Summary: ours over the best peer, above 1 is better", {"", "geometric mean", "worst", "where"});
    const auto add = [&](const std::string& key, const nlohmann::ordered_json& value) {
        if (value.is_object() && value.contains("geomean"))
            table.add({key, ratio_text(value["geomean"]), ratio_text(value["worst"]), value["worst_scene"]});
    };
    for (const auto& [key, value] : summary.items()) add(key, value);
    for (const auto& [count, value] : summary.at("totals").items()) add("total of " + count, value);
    return table.empty() ? std::string() : table.text();
}

} // namespace raywise::bench
