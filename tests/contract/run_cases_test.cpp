// The runner before libraries that are right, and before such that are wrong in one way each.
#include "contract/run_cases.h"

#include "contract/case_json.h"
#include "contract/case_table.h"
#include "contract/check_cases.h"
#include "contract/exact_hits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

namespace raywise::contract {
namespace {

// Exact arithmetic as a library, with a place to spoil each answer.
struct Faults {
    std::function<void(const Ray&, Answer&)> closest = [](const Ray&, Answer&) {};
    std::function<void(bool&)> any = [](bool&) {};
    std::function<void(std::vector<Answer>&)> all = [](std::vector<Answer>&) {};
    std::function<void(std::vector<Answer>&)> batch = [](std::vector<Answer>&) {};
    bool every_touch = false; // counts both triangles of an edge
    bool takes_bad_meshes = false;
    bool reports_wrong_vertex = false;
    bool rounds_to_float32 = false;
    bool fails = false;
    Capabilities capabilities = [] {
        Capabilities full;
        full.has_batch = true;
        full.refuses_bad_meshes = true;
        return full;
    }();
};

class ExactLibraryScene : public Scene {
public:
    ExactLibraryScene(const std::vector<Mesh>& meshes, const Faults& faults) : exact_(meshes), faults_(faults) {}

    Answer closest(const Ray& ray) override {
        const std::vector<Answer> answers = touched(ray, true);
        Answer answer = answers.empty() ? Answer{} : answers[0];
        faults_.closest(ray, answer);
        return answer;
    }
    bool any(const Ray& ray) override {
        bool answer = !touched(ray, true).empty();
        faults_.any(answer);
        return answer;
    }
    void all(const Ray& ray, std::vector<Answer>& answers) override {
        answers = touched(ray, faults_.every_touch);
        faults_.all(answers);
    }
    void closest_batch(const std::vector<Ray>& rays, std::vector<Answer>& answers) override {
        answers.clear();
        for (const Ray& ray : rays) answers.push_back(closest(ray));
        faults_.batch(answers);
    }

private:
    std::vector<Answer> touched(const Ray& ray, bool uncounted_too) const {
        std::vector<Answer> answers;
        for (const ExactAnswer& touch : exact_.answers(ray).touched) {
            if (!touch.counted && !uncounted_too) continue;
            answers.push_back({true, touch.t.convert_to<double>(), 0.25, 0.25, touch.id.geometry, touch.id.primitive});
        }
        return answers;
    }

    ExactScene exact_;
    const Faults& faults_;
};

class ExactLibrary : public Library {
public:
    explicit ExactLibrary(Faults faults = {}) : faults_(std::move(faults)) {}
    std::string name() const override { return "exact arithmetic"; }
    Capabilities capabilities() const override { return faults_.capabilities; }
    std::unique_ptr<Scene> build(const std::vector<Mesh>& meshes) override {
        if (faults_.fails) throw std::runtime_error("out of luck");
        std::vector<Mesh> own = meshes;
        for (Mesh& mesh : own) {
            for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
                Vec3& v = mesh.vertices[i];
                if (!is_finite(v) && !mesh.skip_invalid && !faults_.takes_bad_meshes)
                    throw Refusal("not-finite", "vertex " + std::to_string(faults_.reports_wrong_vertex ? 77 : i));
                if (faults_.rounds_to_float32) v = Vec3(Vec3f(v));
            }
        }
        return std::make_unique<ExactLibraryScene>(own, faults_);
    }

private:
    Faults faults_;
};

// One case per kind of expectation.
const char* const text =
    "family kinds\n"
    "about One case per kind.\n"
    "case hit\nabout .\nmesh box 2 2 2\nray 0.5 0.25 5 0 0 -1\nexpect hit\n"
    "case miss\nabout .\nmesh box 2 2 2\nray 0.5 0.25 5 0 0 1\nexpect miss\n"
    "case t\nabout .\nmesh box 2 2 2\nray 0.5 0.25 5 0 0 -1\nexpect t 4\n"
    "case primitive\nabout .\nmesh box 2 2 2\nray 0.5 0.25 5 0 0 -1\nexpect primitive 3 2\n"
    "case lowest\nabout .\nmesh stack 3\nray 0.5 0.25 5 0 0 -1\nexpect lowest 0\n"
    "case count\nabout .\nmesh box 2 2 2\nray 0.5 0.5 5 0 0 -1\nexpect count 2\n"
    "case even\nabout .\nmesh box 2 2 2\nray 3 3 3 -1 -1 -1\nexpect even\nexpect outside\n"
    "case odd\nabout .\nmesh box 2 2 2\nray 0 0 0 1 1 0\nexpect odd\nexpect inside\n"
    "case all-t\nabout .\nmesh box 2 2 2\nray 0.5 0.5 5 0 0 -1\nexpect all-t 4 6\n"
    "case exact\nabout .\nmesh soup 30 1\nmesh icosphere 1\ngrid 0x1p-10\nrays random 40 1\nrays vertices-from-outside "
    "20 2\nexpect exact\n"
    "case plane\nabout .\nmesh icosphere 1\nrays cone 30 1 0 0 -4 0 0 1 0.1\nexpect plane\n"
    "case batch\nabout .\nmesh icosphere 1\nrays cone 30 1 0 0 -4 0 0 1 0.1\nexpect same-as-batch\n"
    "case repeatable\nabout .\nmesh icosphere 1\nrays cone 30 1 0 0 -4 0 0 1 0.1\nexpect repeatable 2\n"
    "case refused\nabout .\nv 0 0 0\nv nan 0 0\nv 0 1 0\nf 0 1 2\nexpect error not-finite vertex 1\n"
    "case double\nabout .\nv 1e6 0 0\nv 1000000.01 0 0\nv 1e6 0.01 0\nf 0 1 2\n"
    "ray 1000000.0049 0.0049 1 0 0 -1\nexpect hit\nray 1000000.0051 0.0051 1 0 0 -1\nexpect miss\n"
    "case two-geometries\nabout .\nmesh box 2 2 2\ngeometry\nmesh box 4 4 4\nray 0 0 0 0.25 0.5 1\nexpect primitive "
    "0:2 "
    "0:3\n"
    "case absent\nabout .\nmesh file no-such-file.obj\nray 0 0 0 0 0 1\nexpect hit\n";

LibraryResult run(Faults faults = {}) {
    ExactLibrary library(std::move(faults));
    return run_cases(library, {parse_cases(text, "kinds.txt")});
}

std::vector<std::string> with(const LibraryResult& result, Outcome outcome) {
    std::vector<std::string> names;
    for (const CaseResult& one : result.cases) {
        if (one.outcome == outcome) names.push_back(one.name);
    }
    return names;
}
std::vector<std::string> failed(Faults faults) { return with(run(std::move(faults)), Outcome::failed); }
const CaseResult& named(const LibraryResult& result, const std::string& name) {
    return *std::find_if(result.cases.begin(), result.cases.end(), [&](const CaseResult& r) { return r.name == name; });
}
using Names = std::vector<std::string>;
bool has(const Names& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(RunCases, WhatIsRightPasses) {
    const LibraryResult result = run();
    for (const CaseResult& one : result.cases)
        EXPECT_NE(one.outcome, Outcome::failed) << one.name << ": " << one.reason;
    EXPECT_EQ(with(result, Outcome::skipped), Names{"absent"});
    EXPECT_EQ(named(result, "absent").reason, "the mesh file no-such-file.obj is not here");
    EXPECT_EQ(result.count(Outcome::passed), result.cases.size() - 1);
    EXPECT_EQ(named(result, "exact").rays, 60u);
}

TEST(RunCases, MissesAreSeen) {
    Faults faults;
    faults.closest = [](const Ray&, Answer& answer) { answer = {}; };
    const LibraryResult result = run(faults);
    EXPECT_FALSE(has(with(result, Outcome::passed), "hit"));
    EXPECT_EQ(named(result, "hit").failed_questions, (std::set<std::string>{"any", "closest"}));
    EXPECT_EQ(named(result, "hit").reason, "kinds.txt:6: any-hit says hit, closest says a miss; ray 0.5 0.25 5 0 0 -1");
    EXPECT_EQ(named(result, "miss").outcome, Outcome::passed);
}

TEST(RunCases, HitsThatAreNotThereAreSeen) {
    Faults faults;
    faults.closest = [](const Ray&, Answer& answer) {
        if (!answer.hit) answer = {true, 1.0, 0, 0, 0, 0};
    };
    const Names names = failed(faults);
    EXPECT_TRUE(has(names, "miss") && has(names, "exact"));
    EXPECT_FALSE(has(names, "hit"));
}

TEST(RunCases, WrongDistancesAreSeen) {
    Faults faults;
    faults.closest = [](const Ray&, Answer& answer) { answer.t += 1e-9; };
    faults.all = [](std::vector<Answer>& all) {
        for (Answer& answer : all) answer.t += 1e-9;
    };
    const Names names = failed(faults);
    for (const char* name : {"t", "all-t", "exact", "plane"}) EXPECT_TRUE(has(names, name)) << name;
    EXPECT_FALSE(has(names, "primitive") || has(names, "hit"));
    // Unless the library does not claim better.
    faults.capabilities.t_tolerance = 1e-8;
    EXPECT_EQ(failed(faults), Names{});
}

TEST(RunCases, NotTheClosestIsSeen) {
    Faults faults;
    faults.closest = [](const Ray& ray, Answer& answer) {
        if (answer.hit && ray.direction.z == -1.0) answer = {true, 6.0, 0, 0, 0, 0};
    };
    const Names names = failed(faults);
    EXPECT_TRUE(has(names, "t") && has(names, "primitive"));
}

TEST(RunCases, WrongTrianglesAreSeen) {
    Faults faults;
    faults.closest = [](const Ray&, Answer& answer) { answer.primitive += 2; };
    const Names names = failed(faults);
    for (const char* name : {"primitive", "lowest", "exact", "plane"}) EXPECT_TRUE(has(names, name)) << name;
    faults.closest = [](const Ray&, Answer& answer) { answer.geometry += 1; };
    EXPECT_TRUE(has(failed(faults), "two-geometries"));
}

TEST(RunCases, DisagreementsAreSeen) {
    Faults faults;
    faults.any = [](bool& any) { any = !any; };
    EXPECT_EQ(named(run(faults), "miss").failed_questions, std::set<std::string>{"any"});
    faults = {};
    faults.all = [](std::vector<Answer>& all) {
        if (!all.empty()) all.front().t -= 1e-6;
    };
    EXPECT_EQ(named(run(faults), "hit").failed_questions, std::set<std::string>{"all"});
    faults.all = [](std::vector<Answer>& all) { std::reverse(all.begin(), all.end()); };
    EXPECT_TRUE(has(failed(faults), "hit"));
}

TEST(RunCases, CountingAnEdgeTwiceIsSeenAndOnlyConcernsAllHits) {
    Faults faults;
    faults.every_touch = true;
    const LibraryResult result = run(faults);
    const Names names = with(result, Outcome::failed);
    for (const char* name : {"count", "odd", "all-t", "exact"}) EXPECT_TRUE(has(names, name)) << name;
    EXPECT_FALSE(has(names, "hit"));
    EXPECT_EQ(named(result, "count").failed_questions, std::set<std::string>{"all"});
    EXPECT_GT(result.passed_by_closest(), result.count(Outcome::passed));
}

TEST(RunCases, BatchesThatDifferAreSeen) {
    Faults faults;
    faults.batch = [](std::vector<Answer>& answers) { answers.back().u += 0x1p-52; };
    EXPECT_EQ(failed(faults), Names{"batch"});
    faults.batch = [](std::vector<Answer>& answers) { answers.pop_back(); };
    EXPECT_EQ(failed(faults), Names{"batch"});
}

TEST(RunCases, DriftIsSeen) {
    Faults faults;
    int calls = 0;
    faults.closest = [&calls](const Ray&, Answer& answer) { answer.u += 0x1p-50 * ++calls; };
    const Names names = failed(faults);
    EXPECT_TRUE(has(names, "repeatable") && has(names, "batch"));
    EXPECT_FALSE(has(names, "exact"));
}

TEST(RunCases, MeshesThatHadToBeRefusedAreSeen) {
    Faults faults;
    faults.takes_bad_meshes = true;
    EXPECT_EQ(failed(faults), Names{"refused"});
    faults.takes_bad_meshes = false;
    faults.reports_wrong_vertex = true;
    EXPECT_EQ(named(run(faults), "refused").reason, "expected an error that mentions \"vertex 1\", got: vertex 77");
    faults.fails = true;
    EXPECT_EQ(named(run(faults), "hit").reason, "the library failed: out of luck");
    EXPECT_EQ(run(faults).count(Outcome::passed), 0u);
}

// A float64 case is no excuse.
TEST(RunCases, ALibraryThatRoundsFailsWhereItMatters) {
    Faults faults;
    faults.rounds_to_float32 = true;
    EXPECT_EQ(failed(faults), Names{"double"});
}

TEST(RunCases, WhatALibraryHasNoCallForIsSkipped) {
    Faults faults;
    faults.capabilities = {};
    faults.capabilities.has_any = faults.capabilities.has_all = faults.capabilities.orders_ties = false;
    faults.capabilities.many_geometries = false;
    const LibraryResult result = run(faults);
    EXPECT_EQ(with(result, Outcome::failed), Names{});
    EXPECT_EQ(with(result, Outcome::skipped),
              (Names{"lowest", "count", "even", "odd", "all-t", "batch", "refused", "two-geometries", "absent"}));
    EXPECT_EQ(named(result, "lowest").reason, "has no call for what is expected");
}

TEST(RunCases, SweepsGrowByTheirFactor) {
    ExactLibrary library;
    RunOptions options;
    options.sweep_factor = 3;
    std::vector<std::string> begun;
    options.begins = [&](const std::string& family) { begun.push_back(family); };
    EXPECT_EQ(named(run_cases(library, {parse_cases(text, "kinds.txt")}, options), "exact").rays, 180u);
    EXPECT_EQ(begun, Names{"kinds"});
}

TEST(CaseTable, FitsAHundredColumnsAndSaysWhatFailed) {
    Faults faults;
    faults.closest = [](const Ray&, Answer& answer) { answer = {}; };
    LibraryResult bad = run(faults);
    std::vector<LibraryResult> results;
    for (int i = 0; i < 9; ++i) {
        results.push_back(i == 8 ? bad : run());
        results.back().library = "library number" + std::to_string(i);
    }
    const std::string table = table_of(results);
    std::istringstream lines(table);
    std::string line;
    while (std::getline(lines, line)) EXPECT_LE(line.size(), 100u) << line;
    EXPECT_NE(table.find("kinds"), std::string::npos);
    EXPECT_NE(table.find("16/16"), std::string::npos);
    EXPECT_NE(table.find("kinds/hit: kinds.txt:6: any-hit says hit, closest says a miss"), std::string::npos);
    EXPECT_NE(table.find("failed by library number8"), std::string::npos);
}

TEST(CaseReport, SumsUpOverLibraries) {
    Faults faults;
    faults.every_touch = true;
    LibraryResult bad = run(faults);
    bad.library = "bad";
    const auto report = report_of({run(), bad});
    EXPECT_EQ(report["rows"].size(), 34u);
    EXPECT_EQ(report["summary"]["hard_cases"], 16);
    EXPECT_EQ(report["summary"]["hard_cases_passed"], bad.count(Outcome::passed));
    EXPECT_EQ(report["summary"]["libraries"]["exact arithmetic"]["hard_cases_passed"], 16);
    EXPECT_EQ(report["summary"]["libraries"]["bad"]["hard_cases_skipped"], 1);
}

TEST(CaseExport, HoldsEverythingARunnerNeeds) {
    const Family family = parse_cases(
        "family a\ncase b\nabout It.\nprecision float32\nv 0 0 0\nv 0x1p-149 nan 0\nv 0 1 -inf\nf 0 1 2\n"
        "ray 0 -0.0 0 0 0 1 -inf inf\nexpect primitive 1:2 3\nexpect t 0x1.fffffep-1\n"
        "case c\nabout It.\nmesh box 2 2 2\nrays vertices-from-point all 0 0 0 0\nexpect exact\n"
        "case d\nabout It.\nmesh file no-such-file.obj\nray 0 0 0 0 0 1\nexpect hit\n",
        "a.txt");
    const auto json = nlohmann::json::parse(export_of({family}, 1).dump());
    const auto& first = json["families"][0]["cases"][0];
    EXPECT_EQ(json["format"], 1);
    EXPECT_EQ(first["precision"], "float32");
    EXPECT_EQ(first["geometries"][0]["vertices"][1][0].get<double>(), 0x1p-149);
    EXPECT_EQ(first["geometries"][0]["vertices"][1][1], "nan");
    EXPECT_EQ(first["geometries"][0]["vertices"][2][2], "-inf");
    EXPECT_EQ(first["groups"][0]["rays"][0].dump(), "[0.0,-0.0,0.0,0.0,0.0,1.0,\"-inf\",\"inf\"]");
    EXPECT_EQ(first["groups"][0]["expectations"][0]["ids"].dump(), "[[1,2],[0,3]]");
    EXPECT_EQ(first["groups"][0]["expectations"][1]["numbers"][0].get<double>(), 0x1.fffffep-1);
    const auto& second = json["families"][0]["cases"][1]["groups"][0];
    EXPECT_EQ(second["rays"].size(), 8u);
    EXPECT_EQ(second["reach"].size(), 8u);
    ASSERT_EQ(second["exact"].size(), 8u);
    EXPECT_EQ(second["exact"][0]["touched"][0][0], 1.0);
    EXPECT_EQ(second["exact"][0]["count_certain"], true);
    EXPECT_EQ(json["families"][0]["cases"][2]["skipped"], "the mesh file no-such-file.obj is not here");
}

TEST(CheckCases, FindsFaultsInFiles) {
    const auto faults = [](const std::string& lines) {
        return faults_of({parse_cases("family a\ncase b\nabout It.\nmesh box 2 2 2\n" + lines, "a.txt")}, 1);
    };
    EXPECT_EQ(
        faults("ray 0.5 0.25 5 0 0 -1\nexpect hit\nexpect t 4\nexpect primitive 2\nexpect count 2\nexpect even\n"),
        Names{});
    const std::string ray = "; ray 0.5 0.25 5 0 0 -1";
    const std::pair<const char*, const char*> wrong[] = {
        {"miss", "a hit at t 4"},        {"t 4.000001", "t 4"},   {"primitive 0 1", "triangle 0:2"},
        {"lowest 3", "triangle 0:2"},    {"count 1", "2 in all"}, {"odd", "2 in all"},
        {"all-t 4 6.000001", "2 in all"}};
    for (const auto& [expectation, instead] : wrong) {
        EXPECT_EQ(
            faults("ray 0.5 0.25 5 0 0 -1\nexpect " + std::string(expectation) + "\n"),
            Names{"a.txt:6: expects " + std::string(expectation) + ", but exact arithmetic finds " + instead + ray});
    }
    EXPECT_EQ(faults("ray 0.5 0.25 5 0 0 1\nexpect hit\n"),
              Names{"a.txt:6: expects hit, but exact arithmetic finds a miss; ray 0.5 0.25 5 0 0 1"});
    EXPECT_EQ(faults("expect error not-finite\n"), Names{"a.txt:2: nothing in the meshes is not-finite"});
    EXPECT_EQ(faults("expect error index-range\n"), Names{"a.txt:2: nothing in the meshes is index-range"});
}

} // namespace
} // namespace raywise::contract
