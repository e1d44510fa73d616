// What the run found: as a page for docs/ and as JSON.
#pragma once

#include "contract/case_file.h"
#include "contract/report_json.h"
#include "contract/run_cases.h"

#include <string>
#include <vector>

namespace raywise::contract {

struct Entrant {
    std::string version;
    std::string note; // how it is asked
    std::string why;  // what lies behind most of its failures; may be empty
    LibraryResult result;
};

// One result for several forms of a library: a case is passed when no form fails it and at least one answers it.
LibraryResult together(const std::string& name, const std::vector<LibraryResult>& forms);

std::string page_of(const sweep::ReportHead& head, const std::vector<Family>& families,
                    const std::vector<Entrant>& entrants);

// {"target", "machine", "commit", "date", "command", "rows": one for each case and library, "summary": by library}.
sweep::Json peers_json(const sweep::ReportHead& head, const std::vector<Entrant>& entrants);

} // namespace raywise::contract
