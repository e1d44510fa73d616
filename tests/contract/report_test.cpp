#include "contract/report_json.h"

#include "contract/sweep_result.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace raywise::sweep {
namespace {

const ReportHead head{"contract", "some processor, 2 threads", "0123abcd", "2026-01-02T03:04:05Z", "make contract"};

Json part(const char* key, int value) {
    Json part = empty_part();
    part["rows"].push_back({{"name", key}});
    part["summary"][key] = value;
    return part;
}

SweepResult sample_result() {
    SweepResult result;
    result.seed = 9;
    result.comparisons_wanted = 100;
    result.edge_rays_wanted = 50;
    AgreementRow row{"hard", "a scene with a name that is far too long for any table to show", 12, {}};
    row.count.rays = 10;
    row.count.comparisons = 100;
    result.agreement.push_back(row);
    WatertightRow mesh{"a closed mesh with a name that is far too long for any table to show", 20, true, {}};
    mesh.count.rays = 50;
    result.watertight.push_back(mesh);
    return result;
}

TEST(Report, HasTheMembersOfEveryDeskTarget) {
    const Json report = merged_report(head, {part("comparisons", 5), part("hard_cases", 7)});
    std::vector<std::string> keys;
    for (const auto& [key, value] : report.items()) keys.push_back(key);
    const std::vector<std::string> wanted = {"target", "machine", "commit", "date", "command", "rows", "summary"};
    EXPECT_EQ(keys, wanted);
    EXPECT_EQ(report["target"], "contract");
    EXPECT_EQ(report["rows"].size(), 2u);
    EXPECT_EQ(report["summary"]["comparisons"], 5);
    EXPECT_EQ(report["summary"]["hard_cases"], 7);
}

TEST(Report, RefusesPartsOfAnotherShape) {
    EXPECT_THROW(merged_report(head, {Json::array()}), std::runtime_error);
    EXPECT_THROW(merged_report(head, {Json{{"rows", Json::array()}}}), std::runtime_error);
    EXPECT_THROW(merged_report(head, {Json{{"rows", 1}, {"summary", Json::object()}}}), std::runtime_error);
    EXPECT_THROW(merged_report(head, {part("leaks", 1), part("leaks", 1)}), std::runtime_error);
}

TEST(Report, IsWrittenAndReadBack) {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("raywise-report-test-" + std::to_string(::getpid()) + ".json");
    const Json report = merged_report(head, {part("comparisons", 5)});
    write_json(path, report);
    EXPECT_EQ(read_json(path), report);
    std::ofstream(path) << "{";
    EXPECT_THROW(read_json(path), std::runtime_error);
    std::filesystem::remove(path);
    EXPECT_THROW(read_json(path), std::runtime_error);
    EXPECT_THROW(write_json(path / "no folder" / "report.json", report), std::runtime_error);
}

TEST(Report, NamesMachineAndDate) {
    EXPECT_NE(machine_text().find("thread"), std::string::npos);
    const std::string date = date_text();
    ASSERT_EQ(date.size(), 20u);
    EXPECT_EQ(date[10], 'T');
    EXPECT_EQ(date[19], 'Z');
}

TEST(SweepResult, SummarisesUnderTheNamesOfTheDesign) {
    const Json report = merged_report(head, {part_of(sample_result())});
    EXPECT_EQ(report["rows"].size(), 2u);
    EXPECT_EQ(report["summary"]["comparisons"], 100);
    EXPECT_EQ(report["summary"]["disagreements"], 0);
    EXPECT_EQ(report["summary"]["edge_rays"], 50);
    EXPECT_EQ(report["summary"]["leaks"], 0);
    EXPECT_EQ(report["summary"]["complete"], true);
    EXPECT_EQ(report["summary"]["seed"], 9);
}

TEST(SweepResult, IsIncompleteWithFewerAnswersThanWanted) {
    SweepResult result = sample_result();
    EXPECT_TRUE(result.complete());
    result.comparisons_wanted = 101;
    EXPECT_FALSE(result.complete());
    result = sample_result();
    result.edge_rays_wanted = 51;
    EXPECT_FALSE(result.complete());
    result = sample_result();
    result.interrupted = true;
    EXPECT_FALSE(result.complete());
    EXPECT_NE(table_of(result).find("INCOMPLETE"), std::string::npos);
    EXPECT_EQ(part_of(result)["summary"]["complete"], false);
}

TEST(SweepResult, IsWrongWithAnyFault) {
    EXPECT_TRUE(sample_result().right());
    for (std::uint64_t AgreementCount::*member :
         {&AgreementCount::disagreements, &AgreementCount::judge_disagreements}) {
        SweepResult result = sample_result();
        result.agreement[0].count.*member = 1;
        EXPECT_FALSE(result.right());
    }
    for (std::uint64_t WatertightCount::*member : {&WatertightCount::leaks, &WatertightCount::parity_errors}) {
        SweepResult result = sample_result();
        result.watertight[0].count.*member = 1;
        EXPECT_FALSE(result.right());
    }
}

TEST(SweepResult, FitsAHundredColumns) {
    SweepResult result = sample_result();
    result.agreement[0].count = {99999999999, 99999999999, 999999999999, 999999999,
                                 99999999999, 999999999,   99999.9,      {}};
    result.watertight[0].count = {9999999999, 999999, 9999999999, 999999999, 99999.9, {}};
    std::istringstream lines(table_of(result));
    std::string line;
    while (std::getline(lines, line)) EXPECT_LE(line.size(), 100u) << line;
}

} // namespace
} // namespace raywise::sweep
