// The summary of bench.json: geometric means and worst scenes of what the issue sets targets for.
#pragma once

#include "bench/session.h"

#include <nlohmann/json.hpp>

#include <string>

namespace raywise::bench {

nlohmann::ordered_json summary_of(const Session& session);
std::string summary_text(const nlohmann::ordered_json& summary);

} // namespace raywise::bench
