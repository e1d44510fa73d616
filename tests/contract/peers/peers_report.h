// What the run found: as a page for docs/ and as JSON.
#pragma once

#include "contract/case_file.h"
#include "contract/run_cases.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace raywise::contract {

struct Entrant {
    std::string version;
    std::string note; // how it is asked
    std::string why;  // what lies behind most of its failures; may be empty
    LibraryResult result;
};

// Where, when and of what the run was.
struct RunFacts {
    std::string machine;
    std::string commit;
    std::string date; // ISO 8601, the day
    std::string command;
};

// One result for several forms of a library: a case is passed when no form fails it and at least one answers it.
LibraryResult together(const std::string& name, const std::vector<LibraryResult>& forms);

std::string page_of(const RunFacts& facts, const std::vector<Family>& families, const std::vector<Entrant>& entrants);

// {"target", "machine", "commit", "date", "command", "rows": one for each case and library, "summary": by library}.
nlohmann::ordered_json peers_json(const RunFacts& facts, const std::vector<Entrant>& entrants);

} // namespace raywise::contract
