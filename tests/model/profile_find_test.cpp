// The order in which profiles are looked for.
#include "model/profile.h"
#include "profile_fixture.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

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
