// From a request to a built structure: predict, probe or measure as asked, decide, build.
#pragma once

#include "accel/accel.h"
#include "geometry/primitives.h"
#include "model/decide.h"
#include "model/hapala_rule.h"
#include "model/profile.h"
#include "model/workload.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace raywise {

// Values as RW_EFFORT_* and RW_RULE_* in raywise.h.
enum class Effort {
    estimate = 0,
    probe = 1,
    measure = 2
};
enum class Rule {
    smallest_total = 0,
    hapala = 1
};

struct Plan;

// The same geometry before it moved, with what was planned and built for it.
struct PlanBefore {
    const Plan& plan;
    const Accel& accel;
    std::uint64_t hittable_count;
};

struct PlanRequest {
    std::shared_ptr<const Primitives> primitives;
    std::shared_ptr<const Profile> profile;
    Workload workload;
    std::vector<Ray> sample; // of the caller's rays; empty: made up
    Effort effort = Effort::estimate;
    Rule rule = Rule::smallest_total;
    double time_limit_seconds = 0.0; // of Effort::measure; 0: none
    std::optional<Structure> forced;
    std::uint64_t memory_limit = 0; // bytes; 0: none
    std::optional<ViewFrame> view;
    // A structure that is there already and costs nothing to build: the scene's, when a view is planned.
    std::optional<Structure> ready;
    std::shared_ptr<const Accel> ready_accel;
    // Its structure is refitted, or the same built anew, as long as about as many primitives can be hit.
    std::optional<PlanBefore> before;
};

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

struct PlannedCandidate {
    Structure structure;
    Cost predicted;
    bool applicable = true;  // has a meaning here
    bool over_limit = false; // would not fit the memory limit, as predicted or as built
    bool measured = false;   // built and timed while choosing
    double actual_build_ns = unknown;
    double actual_ray_ns = unknown; // of the sample
    std::uint64_t actual_bytes = 0; // 0: not known
};

// Of a scene made from one whose geometry has moved.
struct RefitReport {
    std::uint64_t refits = 0;  // since the structure was built; 0: it was built for this scene
    double cost = 1.0;         // what a ray is taken to cost in the refitted tree, over the same when that was built
    const char* obstacle = ""; // why it was built anew
};

struct Plan {
    std::vector<PlannedCandidate> candidates; // in the order of the structure list
    Structure chosen = Structure::linear_scan;
    bool forced = false;
    Workload workload;
    SceneFeatures features; // that the predictions are made of
    Effort effort = Effort::estimate;
    Rule rule = Rule::smallest_total;
    std::optional<HapalaDecision> hapala;
    std::optional<RefitReport> refit;
    double decide_ns = 0.0; // everything but the build of the chosen structure
    double build_ns = 0.0;  // of the chosen structure
    std::uint64_t bytes = 0;

    const PlannedCandidate& candidate(Structure structure) const {
        return candidates[static_cast<std::size_t>(structure)];
    }
    PlannedCandidate& candidate(Structure structure) { return candidates[static_cast<std::size_t>(structure)]; }
};

struct PlannedAccel {
    Plan plan;
    std::shared_ptr<const Accel> accel;
};

// Throws Error with ERROR_MEMORY_LIMIT when nothing fits, ERROR_CANCELLED when the caller stops it.
PlannedAccel plan_and_build(const PlanRequest& request, const Parallel& parallel, Progress& progress);

} // namespace raywise
