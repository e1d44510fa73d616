// Why this structure: the plan with its figures, as text and as JSON.
#pragma once

#include "scene/planner.h"
#include "scene/tracer.h"

#include <string>

namespace raywise {

// One candidate with everything known by now; for the chosen one that includes the batches answered so far.
struct CandidateReport {
    Structure structure;
    bool chosen = false;
    bool forced = false;
    PlannedCandidate figures;
    double predicted_total_ns = unknown; // NaN when the number of rays is unknown
    double break_even_rays = unknown;    // NaN for the chosen one
};

CandidateReport report_candidate(const Plan& plan, const Tracer& tracer, Structure structure);

// Text that fits 100 columns.
std::string explain_text(const Plan& plan, const Tracer& tracer, const Profile& profile);
std::string explain_json(const Plan& plan, const Tracer& tracer, const Profile& profile);

} // namespace raywise
