// Cases and results as JSON.
#pragma once

#include "contract/case_file.h"
#include "contract/run_cases.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace raywise::contract {

// Every case in full: meshes, rays, expectations, and what exact arithmetic says where `exact` or `plane` is expected.
// cases/README.md describes it.
nlohmann::ordered_json export_of(const std::vector<Family>& families, std::uint64_t sweep_factor);

// {"rows": one for each case and library, "summary": {"hard_cases", "hard_cases_passed", "libraries"}}.
nlohmann::ordered_json report_of(const std::vector<LibraryResult>& results);

} // namespace raywise::contract
