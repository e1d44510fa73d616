#include "scene/planner.h"

#include "model/policy.h"
#include "scene/look.h"
#include "scene/sample_rays.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

namespace raywise {
namespace {

using Clock = std::chrono::steady_clock;

double ns_since(Clock::time_point start) {
    return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

// Builds and times candidates, and keeps the one structure that will be used.
class Planner {
public:
    Planner(const PlanRequest& request, const Parallel& parallel, Progress& progress)
        : request_(request), parallel_(parallel), progress_(progress) {
        plan_.workload = request.workload;
        plan_.effort = request.effort;
        plan_.rule = request.rule;
        plan_.forced = request.forced.has_value();
    }

    PlannedAccel run() {
        const Clock::time_point start = Clock::now();
        const bool is_taken = request_.before && take_moved(*request_.before);
        if (!is_taken) predict_all();
        if (is_taken) {
            // The structure is that of before.
        } else if (request_.forced) {
            take_forced();
        } else if (request_.rule == Rule::hapala) {
            take_by_hapala();
        } else if (request_.effort == Effort::measure) {
            take_by_measurement();
        } else {
            if (request_.effort == Effort::probe) probe_grid();
            take_by_prediction();
        }
        plan_.chosen = kept_structure_;
        const PlannedCandidate& chosen = plan_.candidate(kept_structure_);
        plan_.build_ns = chosen.actual_build_ns;
        plan_.bytes = chosen.actual_bytes;
        plan_.decide_ns = std::max(0.0, ns_since(start) - (is_ready(kept_structure_) ? 0.0 : plan_.build_ns));
        progress_.report(1.0, "ready");
        return {std::move(plan_), std::move(kept_)};
    }

private:
    bool is_ready(Structure structure) const { return request_.ready == structure; }

    void predict_all() {
        const Primitives& primitives = *request_.primitives;
        const std::uint32_t looked_at = triangles_to_look_at(primitives.count(), request_.workload);
        plan_.features = look_at(primitives, looked_at);
        for (const Structure structure : all_structures()) {
            PlannedCandidate candidate;
            candidate.structure = structure;
            candidate.predicted =
                raywise::predict(structure, request_.profile->constants, plan_.features, request_.workload);
            if (request_.memory_limit != 0) {
                candidate.predicted = within(structure, request_.profile->constants, candidate.predicted,
                                             plan_.features, static_cast<double>(request_.memory_limit));
            }
            if (is_ready(structure)) {
                candidate.predicted.build_ns = 0.0;
                candidate.predicted.bytes = 0.0;
            }
            candidate.applicable = !needs_view(structure) || request_.view.has_value();
            candidate.over_limit = exceeds_limit(candidate.predicted.bytes);
            plan_.candidates.push_back(candidate);
        }
    }

    bool exceeds_limit(double bytes) const {
        return request_.memory_limit != 0 && bytes > static_cast<double>(request_.memory_limit);
    }

    // Builds a structure and notes what it took. Returns null, and marks the candidate, when it turns out too large.
    std::shared_ptr<const Accel> build_candidate(Structure structure, const char* stage) {
        PlannedCandidate& candidate = plan_.candidate(structure);
        progress_.report(0.0, stage);
        if (is_ready(structure)) {
            candidate.actual_build_ns = 0.0;
            candidate.actual_bytes = request_.ready_accel->bytes();
            return request_.ready_accel;
        }
        const Clock::time_point start = Clock::now();
        return note_built(candidate, build(structure, input()), start);
    }

    BuildInput input() const {
        const MachineConstants& constants = request_.profile->constants;
        return {*request_.primitives,
                {constants.primitive_test_ns, constants.node_step_ns},
                request_.view,
                parallel_,
                progress_,
                !worth_gathering(request_.workload),
                request_.memory_limit,
                request_.workload.rays};
    }

    std::shared_ptr<const Accel> note_built(PlannedCandidate& candidate, std::shared_ptr<const Accel> accel,
                                            Clock::time_point start) const {
        candidate.actual_build_ns = ns_since(start);
        candidate.actual_bytes = accel->bytes();
        if (exceeds_limit(static_cast<double>(candidate.actual_bytes))) {
            candidate.over_limit = true;
            return nullptr;
        }
        return accel;
    }

    void keep(Structure structure, std::shared_ptr<const Accel> accel) {
        kept_structure_ = structure;
        kept_ = std::move(accel);
    }

    [[noreturn]] void fail_over_limit() const {
        double smallest = std::numeric_limits<double>::infinity();
        for (const PlannedCandidate& candidate : plan_.candidates) {
            if (request_.forced ? candidate.structure != *request_.forced : !candidate.applicable) continue;
            const double bytes =
                candidate.actual_bytes != 0 ? static_cast<double>(candidate.actual_bytes) : candidate.predicted.bytes;
            smallest = std::min(smallest, bytes);
        }
        throw Error(Status::ERROR_MEMORY_LIMIT,
                    (request_.forced ? std::string(name_of(*request_.forced)) + " needs about "
                                     : "the smallest candidate needs about ") +
                        std::to_string(static_cast<std::uint64_t>(smallest)) + " bytes, the memory limit is " +
                        std::to_string(request_.memory_limit));
    }

    Refitted refit(const PlanBefore& before, const Cost& predicted) const {
        if (before.policy == RefitPolicy::never) return {nullptr, "it was to be built anew", 1.0};
        const double most = before.policy == RefitPolicy::where_possible
                                ? std::numeric_limits<double>::infinity()
                                : refit_limit(predicted, request_.workload.rays);
        return before.accel.refitted(input(), most);
    }

    // The figures of the decision stay those of before. Returns false, with nothing taken, when it has to be made again: because far
    // fewer or far more primitives can be hit, or what was chosen does not fit the memory limit any more.
    bool take_moved(const PlanBefore& before) {
        const std::uint64_t now = request_.primitives->hittable_count();
        const bool is_kept = request_.forced || before.policy == RefitPolicy::where_possible;
        if (!is_kept && !choice_holds(before.hittable_count, now)) {
            plan_.refit = RefitReport{0, 1.0, "the number of triangles that can be hit has changed"};
            return false;
        }
        plan_.candidates = before.plan.candidates;
        plan_.features = before.plan.features;
        plan_.hapala = before.plan.hapala;
        const Structure structure = before.plan.chosen;
        PlannedCandidate& candidate = plan_.candidate(structure);
        progress_.report(0.0, "refitting");
        const Clock::time_point start = Clock::now();
        Refitted refitted = refit(before, candidate.predicted);
        const std::uint64_t refits = before.plan.refit ? before.plan.refit->refits : 0;
        plan_.refit = RefitReport{refitted.accel ? refits + 1 : 0, refitted.cost, refitted.obstacle};
        std::shared_ptr<const Accel> accel = refitted.accel ? note_built(candidate, std::move(refitted.accel), start)
                                                            : build_candidate(structure, "building");
        if (accel) {
            keep(structure, std::move(accel));
            return true;
        }
        if (request_.forced) fail_over_limit();
        plan_.candidates.clear();
        plan_.hapala.reset();
        plan_.refit = RefitReport{0, 1.0, "it would be over the memory limit"};
        return false;
    }

    void take_forced() {
        const Structure structure = *request_.forced;
        // What was predicted may be wrong: a forced structure is built, and then judged by what it takes.
        std::shared_ptr<const Accel> accel = build_candidate(structure, "building");
        if (!accel) fail_over_limit();
        keep(structure, std::move(accel));
    }

    std::vector<Candidate> eligible_candidates() const {
        std::vector<Candidate> candidates;
        for (const PlannedCandidate& candidate : plan_.candidates) {
            Cost cost = candidate.predicted;
            if (candidate.measured) {
                cost.build_ns = candidate.actual_build_ns;
                cost.ray_ns = candidate.actual_ray_ns;
            }
            candidates.push_back({candidate.structure, cost, candidate.applicable && !candidate.over_limit});
        }
        return candidates;
    }

    void take_by_prediction() {
        for (;;) {
            const std::optional<std::size_t> best = decide(eligible_candidates(), request_.workload.rays);
            if (!best) fail_over_limit();
            const Structure structure = plan_.candidates[*best].structure;
            if (kept_ && structure == kept_structure_) return; // the probed grid
            std::shared_ptr<const Accel> accel = build_candidate(structure, "building");
            if (!accel) continue; // larger than predicted: now marked, take the next
            keep(structure, std::move(accel));
            return;
        }
    }

    // Mean time per sample ray; NaN when there is nothing to time.
    double time_sample(const Accel& accel) {
        if (sample_.empty()) {
            sample_ = request_.sample.empty()
                          ? make_sample_rays(*request_.primitives, request_.workload.kind, request_.view)
                          : request_.sample;
            sample_.erase(
                std::remove_if(sample_.begin(), sample_.end(), [](const Ray& ray) { return !ray.is_traceable(); }),
                sample_.end());
        }
        const bool any = request_.workload.kind == RayKind::shadow;
        std::size_t done = 0;
        const Clock::time_point start = Clock::now();
        double spent = 0.0;
        while (done < sample_.size() && spent < sample_time_limit_ns) {
            const std::size_t end = std::min(sample_.size(), done + 16); // look at the clock now and then only
            for (; done < end; ++done) {
                const bool hit = any ? accel.any(sample_[done], {}) : accel.closest(sample_[done], {}).is_hit();
                sample_hits_ += hit ? 1 : 0;
            }
            spent = ns_since(start);
        }
        return done == 0 ? unknown : spent / static_cast<double>(done);
    }

    bool measure_candidate(Structure structure, std::shared_ptr<const Accel>& accel) {
        accel = build_candidate(structure, "measuring");
        if (!accel) return false;
        PlannedCandidate& candidate = plan_.candidate(structure);
        const double ray_ns = request_.primitives->hittable_count() == 0 ? 0.0 : time_sample(*accel);
        if (ray_ns == ray_ns) { // not NaN
            candidate.actual_ray_ns = ray_ns;
            candidate.measured = true;
        }
        return true;
    }

    void probe_grid() {
        if (plan_.candidate(Structure::uniform_grid).over_limit) return;
        std::shared_ptr<const Accel> grid;
        if (measure_candidate(Structure::uniform_grid, grid)) keep(Structure::uniform_grid, std::move(grid));
    }

    void take_by_hapala() {
        for (PlannedCandidate& candidate : plan_.candidates) {
            candidate.applicable =
                candidate.structure == Structure::uniform_grid || candidate.structure == Structure::kd_tree;
        }
        std::shared_ptr<const Accel> grid;
        if (!plan_.candidate(Structure::uniform_grid).over_limit) measure_candidate(Structure::uniform_grid, grid);
        const PlannedCandidate& grid_candidate = plan_.candidate(Structure::uniform_grid);
        PlannedCandidate& tree_candidate = plan_.candidate(Structure::kd_tree);
        if (grid && grid_candidate.measured) {
            plan_.hapala = hapala_rule(request_.profile->constants.hapala,
                                       static_cast<double>(request_.primitives->hittable_count()),
                                       request_.workload.rays, grid_candidate.actual_ray_ns);
            tree_candidate.predicted.build_ns = plan_.hapala->tree_build_ns;
            tree_candidate.predicted.ray_ns = plan_.hapala->tree_ray_ns;
        }
        const bool keep_grid = grid && (!plan_.hapala || plan_.hapala->keep_grid || tree_candidate.over_limit);
        if (keep_grid) {
            keep(Structure::uniform_grid, std::move(grid));
            return;
        }
        std::shared_ptr<const Accel> tree =
            tree_candidate.over_limit ? nullptr : build_candidate(Structure::kd_tree, "building");
        if (tree) {
            keep(Structure::kd_tree, std::move(tree));
        } else if (grid) {
            keep(Structure::uniform_grid, std::move(grid));
        } else {
            fail_over_limit();
        }
    }

    void take_by_measurement() {
        const Clock::time_point start = Clock::now();
        // The most promising first, so that a time limit cuts off the least.
        std::vector<Structure> order;
        for (const PlannedCandidate& candidate : plan_.candidates) {
            if (candidate.applicable && !candidate.over_limit) order.push_back(candidate.structure);
        }
        const double rays = request_.workload.rays ? static_cast<double>(*request_.workload.rays) : 1e6;
        std::stable_sort(order.begin(), order.end(), [&](Structure a, Structure b) {
            return plan_.candidate(a).predicted.total_ns(rays) < plan_.candidate(b).predicted.total_ns(rays);
        });
        std::vector<std::pair<Structure, std::shared_ptr<const Accel>>> built;
        for (const Structure structure : order) {
            const bool out_of_time =
                request_.time_limit_seconds > 0.0 && ns_since(start) > request_.time_limit_seconds * 1e9;
            if (out_of_time && !built.empty()) break;
            std::shared_ptr<const Accel> accel;
            if (measure_candidate(structure, accel)) built.emplace_back(structure, std::move(accel));
        }
        // Among those that were measured only: a prediction must not beat a measurement.
        std::vector<Candidate> candidates = eligible_candidates();
        for (Candidate& candidate : candidates) {
            candidate.eligible =
                std::any_of(built.begin(), built.end(), [&](const auto& b) { return b.first == candidate.structure; });
        }
        const std::optional<std::size_t> best = decide(candidates, request_.workload.rays);
        if (!best) fail_over_limit();
        for (auto& [structure, accel] : built) {
            if (structure == candidates[*best].structure) keep(structure, std::move(accel));
        }
    }

    const PlanRequest& request_;
    const Parallel& parallel_;
    Progress& progress_;
    Plan plan_;
    std::vector<Ray> sample_;
    std::size_t sample_hits_ = 0; // keeps the timed calls from being optimised away
    Structure kept_structure_ = Structure::linear_scan;
    std::shared_ptr<const Accel> kept_;
};

} // namespace

PlannedAccel plan_and_build(const PlanRequest& request, const Parallel& parallel, Progress& progress) {
    const bool on_threads = worth_build_threads(request.primitives->count());
    const Parallel used = on_threads ? parallel : parallel.without_own_threads();
    return Planner(request, used, progress).run();
}

} // namespace raywise
