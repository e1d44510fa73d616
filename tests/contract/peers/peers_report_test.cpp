#include "contract/peers/peers_report.h"

#include <gtest/gtest.h>

namespace raywise::contract {
namespace {

CaseResult result(const std::string& name, Outcome outcome, const std::string& reason = "") {
    CaseResult one;
    one.family = "f";
    one.name = name;
    one.outcome = outcome;
    one.reason = reason;
    if (outcome == Outcome::failed) one.failed_questions = {"closest"};
    return one;
}

Entrant entrant(const std::string& library, const std::vector<CaseResult>& cases) {
    return {"1.0", "by its call", "It is made up.", {library, cases}};
}

std::vector<Family> one_family() {
    return {parse_cases(
        "family f\nabout f\ncase a\nabout a\nconvention Others | may differ.\nexpect error not-finite x\n", "f.txt")};
}

const sweep::ReportHead head = {"contract-peers", "a machine", "abc", "2026-11-26T01:02:03Z", "make contract-peers"};

TEST(Together, EveryFormHasToPass) {
    const LibraryResult all = together("both", {{"both first",
                                                 {result("a", Outcome::passed), result("b", Outcome::failed, "x"),
                                                  result("c", Outcome::skipped), result("d", Outcome::skipped)}},
                                                {"both second",
                                                 {result("a", Outcome::failed, "y"), result("b", Outcome::passed),
                                                  result("c", Outcome::passed), result("d", Outcome::skipped)}}});
    EXPECT_EQ(all.library, "both");
    EXPECT_EQ(all.cases[0].outcome, Outcome::failed);
    EXPECT_EQ(all.cases[0].reason, "both second: y");
    EXPECT_EQ(all.cases[1].outcome, Outcome::failed);
    EXPECT_EQ(all.cases[1].reason, "both first: x");
    EXPECT_EQ(all.cases[2].outcome, Outcome::passed);
    EXPECT_EQ(all.cases[3].outcome, Outcome::skipped);
}

TEST(Together, FormsOfDifferentCasesAreAMistake) {
    EXPECT_THROW(together("x", {}), std::invalid_argument);
    EXPECT_THROW(together("x", {{"a", {result("a", Outcome::passed)}}, {"b", {}}}), std::invalid_argument);
}

TEST(Json, HasWhatTheReportsOfAllTargetsHave) {
    const auto json =
        peers_json(head, {entrant("ours", {result("a", Outcome::passed), result("b", Outcome::skipped)}),
                          entrant("theirs", {result("a", Outcome::failed), result("b", Outcome::passed)})});
    EXPECT_EQ(json["target"], "contract-peers");
    EXPECT_EQ(json["machine"], "a machine");
    EXPECT_EQ(json["commit"], "abc");
    EXPECT_EQ(json["date"], "2026-11-26T01:02:03Z");
    EXPECT_EQ(json["command"], "make contract-peers");
    EXPECT_EQ(json["rows"].size(), 4u);
    EXPECT_EQ(json["summary"]["ours"]["hard_cases_passed"], 1);
    EXPECT_EQ(json["summary"]["ours"]["hard_cases"], 1);
    EXPECT_EQ(json["summary"]["ours"]["not_applicable"], 1);
    EXPECT_EQ(json["summary"]["theirs"]["hard_cases_passed"], 1);
    EXPECT_EQ(json["summary"]["theirs"]["hard_cases"], 2);
    EXPECT_EQ(json["summary"]["theirs"]["passed_by_closest_hit"], 1);
}

TEST(Page, TellsWhatEachPassesAndWhatItFails) {
    CaseResult failed = result("a", Outcome::failed, "f.txt:3: expected x|y\nand more");
    failed.rays = 9;
    failed.failed_rays = 2;
    failed.convention = "Others may differ.";
    const std::string page =
        page_of(head, one_family(), {entrant("ours", {result("a", Outcome::passed)}), entrant("theirs", {failed})});
    for (const char* line :
         {"| family | ours | theirs |\n", "| f | 1/1 | 0/1 |\n", "| **all** | **1/1** | **0/1** |\n",
          "| failed, matters of convention | 0 | 1 |\n", "### ours\n\nNone.\n", "### theirs\n\nIt is made up.\n",
          "| f/a † | 2/9 | f.txt:3: expected x\\|y |\n", "| f/a | Others \\| may differ. |\n",
          "`make contract-peers` at commit abc, on 2026-11-26, on this machine: a machine"})
        EXPECT_NE(page.find(line), std::string::npos) << line << "\n" << page;
}

} // namespace
} // namespace raywise::contract
