// Puts a library before the cases.
#pragma once

#include "contract/case_file.h"
#include "contract/library.h"

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace raywise::contract {

enum class Outcome {
    passed,
    failed,
    skipped
};

struct CaseResult {
    std::string family;
    std::string name;
    std::string convention; // as in the case
    Outcome outcome = Outcome::passed;
    std::string reason; // of the first failure, or of being skipped
    // What failed: "closest", "any", "all", "batch", "again" (asked twice), "mesh" (taken or refused wrongly) or "library".
    std::set<std::string> failed_questions;
    std::uint64_t rays = 0;
    std::uint64_t failed_rays = 0;
};

struct LibraryResult {
    std::string library;
    std::vector<CaseResult> cases; // in the order of the families

    std::uint64_t count(Outcome outcome) const;
    // Cases that pass when only the closest hit is asked for.
    std::uint64_t passed_by_closest() const;
};

struct RunOptions {
    std::uint64_t sweep_factor = 1;                        // multiplies the rays of sweeps
    std::uint64_t most_sweep_rays = 0;                     // so many of each sweep, spread over it; 0: all
    std::function<void(const std::string& family)> begins; // progress; may be empty
};

LibraryResult run_cases(Library& library, const std::vector<Family>& families, const RunOptions& options = {});

} // namespace raywise::contract
