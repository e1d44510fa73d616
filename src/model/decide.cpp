#include "model/decide.h"

#include <algorithm>
#include <array>
#include <limits>

namespace raywise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The ray counts an unknown number is weighed over: every power of ten for which a scene is worth making. Who asks fewer and does not say so
// waits for the build of a structure that takes some times what asking them of the bare triangles would, milliseconds in all: to let those
// decide would cost whoever asks many a structure that is several times slower for good.
constexpr std::array<double, 7> imagined_ray_counts = {1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};

double best_total(const std::vector<Candidate>& candidates, double rays) {
    double best = infinity;
    for (const Candidate& candidate : candidates) {
        if (candidate.eligible) best = std::min(best, candidate.cost.total_ns(rays));
    }
    return best;
}

// How many times the best candidate's total this one takes in its worst case.
double worst_ratio(const Candidate& candidate, const std::vector<Candidate>& candidates) {
    double worst = 1.0;
    for (const double rays : imagined_ray_counts) {
        const double best = best_total(candidates, rays);
        const double total = candidate.cost.total_ns(rays);
        if (total > best) worst = std::max(worst, best > 0.0 ? total / best : infinity);
    }
    return worst;
}

// The first of those with the smallest score, so that equals are settled by the order of structure_list.def.
template <class Score>
std::optional<std::size_t> smallest(const std::vector<Candidate>& candidates, Score score) {
    std::optional<std::size_t> chosen;
    double chosen_score = infinity;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (!candidates[i].eligible) continue;
        const double its_score = score(candidates[i]);
        if (!chosen || its_score < chosen_score) {
            chosen = i;
            chosen_score = its_score;
        }
    }
    return chosen;
}

} // namespace

std::optional<std::size_t> decide(const std::vector<Candidate>& candidates, std::optional<std::uint64_t> rays) {
    if (rays) {
        const double count = static_cast<double>(*rays);
        return smallest(candidates, [&](const Candidate& candidate) { return candidate.cost.total_ns(count); });
    }
    return smallest(candidates, [&](const Candidate& candidate) { return worst_ratio(candidate, candidates); });
}

double break_even_rays(const Cost& chosen, const Cost& other) {
    const double extra_build = other.build_ns - chosen.build_ns;
    const double saved_per_ray = chosen.ray_ns - other.ray_ns;
    if (saved_per_ray > 0.0) return std::max(0.0, extra_build / saved_per_ray);
    return saved_per_ray == 0.0 && extra_build < 0.0 ? 0.0 : infinity;
}

} // namespace raywise
