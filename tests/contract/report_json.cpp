#include "contract/report_json.h"

#include "model/machine.h"

#include <chrono>
#include <ctime>
#include <fstream>
#include <stdexcept>

namespace raywise::sweep {

Json empty_part() { return {{"rows", Json::array()}, {"summary", Json::object()}}; }

Json merged_report(const ReportHead& head, const std::vector<Json>& parts) {
    Json report = {{"target", head.target},    {"machine", head.machine}, {"commit", head.commit},
                   {"date", head.date},        {"command", head.command}, {"rows", Json::array()},
                   {"summary", Json::object()}};
    for (const Json& part : parts) {
        if (!part.is_object() || !part.contains("rows") || !part.at("rows").is_array() || !part.contains("summary") ||
            !part.at("summary").is_object())
            throw std::runtime_error("a part of a report is an object of an array \"rows\" and an object \"summary\"");
        for (const Json& row : part.at("rows")) report["rows"].push_back(row);
        for (const auto& [key, value] : part.at("summary").items()) {
            if (report["summary"].contains(key))
                throw std::runtime_error("two parts have a summary of \"" + key + "\"");
            report["summary"][key] = value;
        }
    }
    return report;
}

std::string machine_text() {
    const Machine& machine = this_machine();
    return machine.brand + ", " + std::to_string(machine.threads) + (machine.threads == 1 ? " thread" : " threads");
}

std::string date_text() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

Json read_json(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path.string() + ": cannot be read");
    try {
        return Json::parse(file);
    } catch (const Json::parse_error& error) {
        throw std::runtime_error(path.string() + ": " + error.what());
    }
}

void write_json(const std::filesystem::path& path, const Json& json) {
    const std::filesystem::path unfinished = path.string() + ".part";
    {
        std::ofstream file(unfinished);
        file << json.dump(2) << '\n';
        file.flush();
        if (!file) throw std::runtime_error(unfinished.string() + ": cannot be written");
    }
    std::filesystem::rename(unfinished, path);
}

} // namespace raywise::sweep
