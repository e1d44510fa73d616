// The report that every desk target writes: {"target", "machine", "commit", "date", "command", "rows": [...], "summary": {...}}.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace raywise::sweep {

// Keeps the order in which members were put in.
using Json = nlohmann::ordered_json;

// What one program contributes: {"rows": [...], "summary": {...}}.
Json empty_part();

struct ReportHead {
    std::string target;
    std::string machine;
    std::string commit;
    std::string date; // ISO 8601, UTC
    std::string command;
};

// Puts parts together: all rows, and all members of the summaries. Throws std::runtime_error when a part has another shape
// or two parts claim the same member.
Json merged_report(const ReportHead& head, const std::vector<Json>& parts);

// The processor in its own words and the threads this process may use.
std::string machine_text();
// Now.
std::string date_text();

// Throws std::runtime_error with the path when reading or writing fails. A file is complete or not there.
Json read_json(const std::filesystem::path& path);
void write_json(const std::filesystem::path& path, const Json& json);

} // namespace raywise::sweep
