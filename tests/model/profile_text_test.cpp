#include "model/profile.h"
#include "profile_fixture.h"

#include <gtest/gtest.h>

#include <sstream>

namespace raywise {
namespace {

TEST(ProfileText, FitsHundredColumnsAndNamesEverything) {
    Profile profile = sample_profile();
    profile.status = Status::PROFILE_MACHINE;
    profile.reason =
        "/somewhere/else.json: machine.threads: the profile has 64, this machine 2, and more words to break "
        "the line at, so that it has to be continued";
    const std::string text = to_text(profile);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
    for (const char* name : structure_names) EXPECT_NE(text.find(name), std::string::npos) << name;
    for (const char* name : measured_ray_kind_names) EXPECT_NE(text.find(name), std::string::npos) << name;
    for (const char* word : {"eq. 7", "eq. 8", "61.5", "47.25", "11.5", "4.75", "passed over", "2026-11-22T10:20:30Z",
                             "raywise-calibrate test", "N log2 N", "log2 N", "crowding"}) {
        EXPECT_NE(text.find(word), std::string::npos) << word;
    }
}

TEST(ProfileText, SaysWhereTheConstantsComeFrom) {
    EXPECT_NE(to_text(generic_profile()).find("generic constants"), std::string::npos);
}

} // namespace
} // namespace raywise
