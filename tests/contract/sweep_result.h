// What a whole sweep came to: as a table for people and as a part of a report.
#pragma once

#include "contract/report_json.h"
#include "contract/sweep_agreement.h"
#include "contract/sweep_watertight.h"

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::sweep {

struct AgreementRow {
    std::string family;
    std::string name;
    std::uint64_t triangles;
    AgreementCount count;
};

struct WatertightRow {
    std::string name;
    std::uint64_t triangles;
    bool convex;
    WatertightCount count;
};

struct SweepResult {
    std::uint64_t seed = 0;
    std::uint64_t comparisons_wanted = 0;
    std::uint64_t edge_rays_wanted = 0;
    bool interrupted = false;
    std::vector<AgreementRow> agreement;
    std::vector<WatertightRow> watertight;

    AgreementCount agreement_total() const;
    WatertightCount watertight_total() const;
    bool complete() const; // as many as were wanted
    bool right() const;    // nothing was wrong with what was done
};

// At most 100 columns wide.
std::string table_of(const SweepResult& result);
Json part_of(const SweepResult& result);

} // namespace raywise::sweep
