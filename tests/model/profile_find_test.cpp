// The order in which profiles are looked for.
#include "model/profile.h"
#include "profile_fixture.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace raywise {
namespace {

class FindProfile : public testing::Test {
protected:
    // A valid profile that can be told from others by its spread.
    std::filesystem::path put(const std::string& name, double spread) const {
        Profile profile = sample_profile();
        profile.provenance.spread = spread;
        return folder_.write(name, to_json(profile));
    }
    TemporaryFolder folder_;
};

TEST_F(FindProfile, FirstValidWins) {
    ProfilePlaces places;
    EXPECT_EQ(find_profile(places).source, ProfileSource::generic);
    EXPECT_EQ(find_profile(places).status, Status::OK);

    places.system = put("system.json", 0.3);
    EXPECT_EQ(find_profile(places).source, ProfileSource::system);
    EXPECT_EQ(find_profile(places).provenance.spread, 0.3);
    places.user = put("user.json", 0.2);
    EXPECT_EQ(find_profile(places).source, ProfileSource::user);
    EXPECT_EQ(find_profile(places).provenance.spread, 0.2);
    places.environment = put("environment.json", 0.1).string();
    EXPECT_EQ(find_profile(places).source, ProfileSource::environment);
    EXPECT_EQ(find_profile(places).provenance.spread, 0.1);
    EXPECT_EQ(find_profile(places).path, places.environment);
    EXPECT_EQ(find_profile(places).status, Status::OK);
}

TEST_F(FindProfile, BuiltinMeansTheGenericConstants) {
    const ProfilePlaces places{"builtin", put("user.json", 0.2), put("system.json", 0.3)};
    EXPECT_EQ(find_profile(places).source, ProfileSource::generic);
    EXPECT_EQ(find_profile(places).status, Status::OK);
}

TEST_F(FindProfile, FilesThatAreNotThereArePassedOverInSilence) {
    const ProfilePlaces places{"", folder_ / "no-user.json", folder_ / "no-system.json"};
    EXPECT_EQ(find_profile(places).source, ProfileSource::generic);
    EXPECT_EQ(find_profile(places).status, Status::OK);
    EXPECT_EQ(find_profile(places).reason, "");
}

TEST_F(FindProfile, AFileNamedByTheEnvironmentIsMissed) {
    const ProfilePlaces places{(folder_ / "gone.json").string(), put("user.json", 0.2), {}};
    const Profile profile = find_profile(places);
    EXPECT_EQ(profile.source, ProfileSource::user);
    EXPECT_EQ(profile.status, Status::PROFILE_NOT_FOUND);
    EXPECT_NE(profile.reason.find("gone.json"), std::string::npos);
}

TEST_F(FindProfile, ABadFileGivesWayToTheNextAndIsTold) {
    Profile foreign = sample_profile();
    foreign.machine.vendor = "Other";
    const ProfilePlaces places{folder_.write("bad.json", "{").string(), folder_.write("foreign.json", to_json(foreign)),
                               put("system.json", 0.3)};
    const Profile profile = find_profile(places);
    EXPECT_EQ(profile.source, ProfileSource::system);
    EXPECT_EQ(profile.status, Status::PROFILE_MALFORMED); // of the first
    EXPECT_NE(profile.reason.find("bad.json"), std::string::npos);
}

TEST_F(FindProfile, OnlyBadFilesLeaveTheGenericConstants) {
    Profile foreign = sample_profile();
    ++foreign.machine.threads;
    const ProfilePlaces places{"", folder_.write("foreign.json", to_json(foreign)), folder_.path()};
    const Profile profile = find_profile(places);
    EXPECT_EQ(profile.source, ProfileSource::generic);
    EXPECT_EQ(profile.status, Status::PROFILE_MACHINE);
    EXPECT_EQ(to_json(profile), to_json(generic_profile()));
}

// Every combination of what may be in the three places: the first valid file is taken, the first that was passed over is told,
// and the texts say the same as source, status and reason.
TEST_F(FindProfile, SourceStatusReasonAndTextAgree) {
    Profile other_level = sample_profile();
    other_level.machine.instruction_set = "OTHER";
    const std::string whole = to_json(sample_profile());
    struct State {
        const char* name;
        std::string content; // empty: there is no file
        bool is_asked_for;   // whether a place names it at all
        Status status;       // of a file that was looked at; OK: it is taken
    };
    const State states[] = {
        {"unset", "", false, Status::OK},
        {"missing", "", true, Status::PROFILE_NOT_FOUND},
        {"good", whole, true, Status::OK},
        {"truncated", whole.substr(0, whole.size() / 2), true, Status::PROFILE_MALFORMED},
        {"other level", to_json(other_level), true, Status::PROFILE_MACHINE},
    };
    const ProfileSource sources[] = {ProfileSource::environment, ProfileSource::user, ProfileSource::system};
    const char* const labels[] = {" (RAYWISE_CALIBRATION)", " (user)", " (system)"};
    const auto path_in = [&](int place, const State& state) {
        const std::string name = "place" + std::to_string(place) + ".json";
        std::filesystem::remove(folder_ / name);
        if (!state.is_asked_for) return std::filesystem::path();
        return state.content.empty() ? folder_ / name : folder_.write(name, state.content);
    };
    for (const State& environment : states) {
        for (const State& user : states) {
            for (const State& system : states) {
                SCOPED_TRACE(std::string(environment.name) + ", " + user.name + ", " + system.name);
                const State* const found[] = {&environment, &user, &system};
                const std::filesystem::path paths[] = {path_in(0, environment), path_in(1, user), path_in(2, system)};
                ProfileSource source = ProfileSource::generic;
                Status status = Status::OK;
                std::string path, label, passed_over;
                for (int place = 0; place < 3 && source == ProfileSource::generic; ++place) {
                    const State& state = *found[place];
                    if (state.status == Status::OK && !state.content.empty()) {
                        source = sources[place];
                        path = paths[place].string();
                        label = path + labels[place];
                    } else if (status == Status::OK && (place == 0 || !state.content.empty())) {
                        status = state.status; // only the environment's file is missed
                        passed_over = paths[place].string();
                    }
                }
                if (source == ProfileSource::generic) label = "generic constants, compiled in";

                const Profile profile = find_profile({paths[0].string(), paths[1], paths[2]});
                EXPECT_EQ(profile.source, source);
                EXPECT_EQ(profile.path, path);
                EXPECT_EQ(profile.status, status);
                EXPECT_EQ(profile.reason.empty(), status == Status::OK);
                if (status != Status::OK) {
                    EXPECT_EQ(profile.reason.rfind(passed_over + ": ", 0), 0u) << profile.reason;
                }
                EXPECT_EQ(source_text(profile), label);
                std::string text = to_text(profile);
                std::replace(text.begin(), text.end(), '\n', ' ');
                EXPECT_EQ(text.rfind("profile     " + label + " ", 0), 0u) << text;
                EXPECT_EQ(text.find("passed over " + passed_over + ": ") != std::string::npos, status != Status::OK);
                EXPECT_EQ(text.find("generic") != std::string::npos, source == ProfileSource::generic);
            }
        }
    }
}

TEST_F(FindProfile, LooksWhereTheEnvironmentSays) {
    ::setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
    ::unsetenv("RAYWISE_CALIBRATION");
    const std::filesystem::path user = user_profile_path(this_machine());
    EXPECT_EQ(user, folder_.path() / "raywise" / (this_machine().key() + ".json"));
    std::filesystem::create_directory(folder_ / "raywise");
    put("raywise/" + this_machine().key() + ".json", 0.2);
    EXPECT_EQ(find_profile().source, ProfileSource::user);
    EXPECT_EQ(find_profile().path, user.string());

    ::setenv("RAYWISE_CALIBRATION", put("named.json", 0.1).c_str(), 1);
    EXPECT_EQ(find_profile().source, ProfileSource::environment);
    ::setenv("RAYWISE_CALIBRATION", "builtin", 1);
    EXPECT_EQ(find_profile().source, ProfileSource::generic);
    ::setenv("RAYWISE_CALIBRATION", "", 1); // as if it were not set
    EXPECT_EQ(find_profile().source, ProfileSource::user);
    ::unsetenv("RAYWISE_CALIBRATION");
}

TEST_F(FindProfile, WhatWasFoundFirstIsKept) {
    ::setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
    const std::filesystem::path named = put("named.json", 0.1);
    ::setenv("RAYWISE_CALIBRATION", named.c_str(), 1);
    const std::shared_ptr<const Profile> kept = kept_profile();
    EXPECT_EQ(kept->source, ProfileSource::environment);
    EXPECT_EQ(kept->provenance.spread, 0.1);

    put("named.json", 0.2);
    EXPECT_EQ(load_profile(named).provenance.spread, 0.2); // read anew
    EXPECT_EQ(find_profile().provenance.spread, 0.2);
    EXPECT_EQ(kept_profile(), kept);
    ::unsetenv("RAYWISE_CALIBRATION");
    EXPECT_EQ(kept_profile(), kept);
    EXPECT_EQ(kept->provenance.spread, 0.1);
}

TEST_F(FindProfile, TheUsersFolderIsAbsoluteOrNone) {
    const std::string file = this_machine().key() + ".json";
    ::setenv("HOME", "/home/somebody", 1);
    ::setenv("XDG_CACHE_HOME", "relative", 1);
    EXPECT_EQ(user_profile_path(this_machine()), "/home/somebody/.cache/raywise/" + file);
    ::unsetenv("XDG_CACHE_HOME");
    EXPECT_EQ(user_profile_path(this_machine()), "/home/somebody/.cache/raywise/" + file);
    ::setenv("HOME", "relative", 1);
    EXPECT_EQ(user_profile_path(this_machine()), "");
    ::unsetenv("HOME");
    EXPECT_EQ(user_profile_path(this_machine()), "");
    EXPECT_EQ(find_profile().status, Status::OK);
    EXPECT_EQ(system_profile_path(this_machine()), "/etc/raywise/" + file);
}

} // namespace
} // namespace raywise
