#include "scene/explain.h"

#include "scene/testing.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace raywise {
namespace {

using namespace testing;

std::shared_ptr<Scene> scene_for(std::uint64_t rays) {
    return make_scene(make_soup(1000), std::make_shared<const Profile>(generic_profile()), [&](Scene& s) {
        s.set_expected({rays, RayKind::random}, {});
    });
}

TEST(Explain, NamesEveryCandidateOnceAndFitsTheTerminal) {
    const auto scene = scene_for(1000);
    std::istringstream lines(explain_text(scene->plan(), scene->tracer(), *scene->profile()));
    PerStructure<int> seen;
    int chosen = 0;
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), 110u) << line;
        for (const Structure structure : all_structures()) {
            if (line.substr(2, std::string(name_of(structure)).size() + 1) == std::string(name_of(structure)) + " ")
                ++seen[structure];
        }
        chosen += line.rfind("> ", 0) == 0 ? 1 : 0;
    }
    for (const Structure structure : all_structures()) EXPECT_EQ(seen[structure], 1) << name_of(structure);
    EXPECT_EQ(chosen, 1);
}

TEST(Explain, JsonSaysWhatThePlanSays) {
    const auto scene = scene_for(123456);
    const auto json = nlohmann::json::parse(explain_json(scene->plan(), scene->tracer(), *scene->profile()));
    EXPECT_EQ(json.at("expected_rays"), 123456);
    EXPECT_EQ(json.at("triangles"), 1000);
    EXPECT_EQ(json.at("vertices"), "float32");
    EXPECT_EQ(json.at("chosen"), name_of(scene->plan().chosen));
    EXPECT_EQ(json.at("features").size(), scene_features.size());
    for (const SceneFeature& feature : scene_features)
        EXPECT_EQ(json.at("features").at(feature.name), scene->plan().features.*feature.value) << feature.name;
    ASSERT_EQ(json.at("candidates").size(), structure_count);
    for (const Structure structure : all_structures()) {
        const auto& candidate = json.at("candidates")[static_cast<std::size_t>(structure)];
        EXPECT_EQ(candidate.at("structure"), name_of(structure));
        EXPECT_EQ(candidate.at("predicted_build_ns"), scene->plan().candidate(structure).predicted.build_ns);
    }
}

TEST(Explain, TellsWhereTheConstantsCameFromAndWhatWasPassedOver) {
    struct Source {
        ProfileSource source;
        const char* path;
        const char* line; // of the text
        const char* word; // of the JSON
    };
    const Source sources[] = {
        {ProfileSource::generic, "", "calibration: generic, measured 2026-01-02\n", "generic"},
        {ProfileSource::path, "/a.json", "calibration: path, measured 2026-01-02\n", "path"},
        {ProfileSource::environment, "/a.json", "calibration: environment, measured 2026-01-02\n", "environment"},
        {ProfileSource::user, "/a.json", "calibration: user, measured 2026-01-02\n", "user"},
        {ProfileSource::system, "/a.json", "calibration: system, measured 2026-01-02\n", "system"},
    };
    for (const Source& each : sources) {
        for (const Status status : {Status::OK, Status::PROFILE_MALFORMED, Status::PROFILE_MACHINE}) {
            auto profile = std::make_shared<Profile>(generic_profile());
            profile->source = each.source;
            profile->path = each.path;
            profile->provenance.date = "2026-01-02";
            profile->status = status;
            if (status != Status::OK) profile->reason = "/bad.json: it is bad";
            const auto scene = make_scene(make_soup(10), profile, [](Scene&) {});
            const std::string text = explain_text(scene->plan(), scene->tracer(), *profile);
            EXPECT_NE(text.find("\n" + std::string(each.line)), std::string::npos) << text;
            EXPECT_EQ(text.find("\nprofile: /a.json\n") != std::string::npos, *each.path != '\0') << text;
            EXPECT_EQ(text.find("\npassed over: /bad.json: it is bad\n") != std::string::npos, status != Status::OK);
            const auto json = nlohmann::json::parse(explain_json(scene->plan(), scene->tracer(), *profile));
            const auto& calibration = json.at("calibration");
            EXPECT_EQ(calibration.at("source"), each.word);
            EXPECT_EQ(calibration.at("path"), each.path);
            EXPECT_EQ(calibration.at("status"), static_cast<int>(status));
            EXPECT_EQ(calibration.at("reason"), profile->reason);
        }
    }
}

TEST(Explain, TellsTheBreakEvenOfTheOthers) {
    const auto scene = scene_for(1);
    const Plan& plan = scene->plan();
    for (const Structure structure : all_structures()) {
        const CandidateReport report = report_candidate(plan, scene->tracer(), structure);
        if (report.chosen) {
            EXPECT_TRUE(std::isnan(report.break_even_rays));
        } else if (std::isfinite(report.break_even_rays) && report.break_even_rays > 1.0) {
            const double rays = report.break_even_rays * 1.01;
            EXPECT_LT(plan.candidate(structure).predicted.total_ns(rays),
                      plan.candidate(plan.chosen).predicted.total_ns(rays));
        }
    }
}

} // namespace
} // namespace raywise
