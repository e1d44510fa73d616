// Files that are no profile, and profiles that are not for here: each gives the generic constants and a status of its
// own.
#include "model/profile.h"
#include "profile_fixture.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include <sys/stat.h>
#include <unistd.h>

namespace raywise {
namespace {

void expect_generic(const Profile& profile, Status status, const std::string& word) {
    EXPECT_EQ(profile.status, status) << profile.reason;
    EXPECT_NE(profile.reason.find(word), std::string::npos) << profile.reason;
    EXPECT_EQ(profile.source, ProfileSource::generic);
    EXPECT_EQ(profile.path, "");
    EXPECT_EQ(to_json(profile), to_json(generic_profile()));
}

class LoadProfile : public testing::Test {
protected:
    TemporaryFolder folder_;
    const std::string good_ = to_json(sample_profile());
};

TEST_F(LoadProfile, TakesAGoodFile) {
    const std::filesystem::path path = folder_.write("good.json", good_);
    const Profile profile = load_profile(path);
    EXPECT_EQ(profile.status, Status::OK);
    EXPECT_EQ(profile.reason, "");
    EXPECT_EQ(profile.source, ProfileSource::path);
    EXPECT_EQ(profile.path, path.string());
    EXPECT_EQ(to_json(profile), good_);
}

TEST_F(LoadProfile, FollowsALink) {
    std::filesystem::create_symlink(folder_.write("good.json", good_), folder_ / "link.json");
    EXPECT_EQ(load_profile(folder_ / "link.json").status, Status::OK);
}

TEST_F(LoadProfile, MissesAFileThatIsNotThere) {
    expect_generic(load_profile(folder_ / "missing.json"), Status::PROFILE_NOT_FOUND, "missing.json");
    expect_generic(load_profile(""), Status::PROFILE_NOT_FOUND, "no such file");
    const std::filesystem::path file = folder_.write("file", "");
    expect_generic(load_profile(file / "below"), Status::PROFILE_NOT_FOUND, "no such file");
    std::filesystem::create_symlink(folder_ / "missing.json", folder_ / "dangling");
    expect_generic(load_profile(folder_ / "dangling"), Status::PROFILE_NOT_FOUND, "dangling");
}

TEST_F(LoadProfile, RefusesAFolder) {
    expect_generic(load_profile(folder_.path()), Status::PROFILE_UNREADABLE, "not a plain file");
}

TEST_F(LoadProfile, RefusesAPipeWithoutWaitingForAWriter) {
    const std::filesystem::path pipe = folder_ / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    expect_generic(load_profile(pipe), Status::PROFILE_UNREADABLE, "not a plain file");
}

TEST_F(LoadProfile, RefusesDevices) {
    expect_generic(load_profile("/dev/zero"), Status::PROFILE_UNREADABLE, "not a plain file");
    expect_generic(load_profile("/dev/null"), Status::PROFILE_UNREADABLE, "not a plain file");
}

TEST_F(LoadProfile, RefusesALinkToItself) {
    std::filesystem::create_symlink(folder_ / "loop", folder_ / "loop");
    expect_generic(load_profile(folder_ / "loop"), Status::PROFILE_UNREADABLE, "cannot be read");
}

TEST_F(LoadProfile, RefusesAFileItMayNotRead) {
    if (::geteuid() == 0) GTEST_SKIP() << "the superuser may read everything";
    const std::filesystem::path path = folder_.write("secret.json", good_);
    ASSERT_EQ(::chmod(path.c_str(), 0), 0);
    expect_generic(load_profile(path), Status::PROFILE_UNREADABLE, "cannot be read");
}

TEST_F(LoadProfile, RefusesAFileThatFailsWhileItIsRead) {
    // A plain file by its looks whose first page cannot be read.
    if (!std::filesystem::exists("/proc/self/mem")) GTEST_SKIP() << "no such file on this system";
    expect_generic(load_profile("/proc/self/mem"), Status::PROFILE_UNREADABLE, "cannot be read");
}

TEST_F(LoadProfile, RefusesMoreThanOneMebibyte) {
    // Spaces at the end are legal JSON: the size alone is wrong.
    std::string text = good_;
    text.resize(std::size_t{1} << 20, ' ');
    EXPECT_EQ(load_profile(folder_.write("just.json", text)).status, Status::OK);
    text += ' ';
    expect_generic(load_profile(folder_.write("over.json", text)), Status::PROFILE_UNREADABLE, "1 MiB");
    // A sparse file of a tebibyte must not be read at all.
    const std::filesystem::path huge = folder_.write("huge.json", good_);
    ASSERT_EQ(::truncate(huge.c_str(), off_t{1} << 40), 0);
    expect_generic(load_profile(huge), Status::PROFILE_UNREADABLE, "1 MiB");
}

TEST_F(LoadProfile, RefusesBrokenText) {
    expect_generic(load_profile(folder_.write("empty", "")), Status::PROFILE_MALFORMED, "empty");
    expect_generic(load_profile(folder_.write("half", good_.substr(0, good_.size() / 2))), Status::PROFILE_MALFORMED,
                   "half");
    expect_generic(load_profile(folder_.write("zeros", std::string(4096, '\0'))), Status::PROFILE_MALFORMED, "zeros");
}

TEST_F(LoadProfile, TellsTheMemberThatIsWrong) {
    std::string text = good_;
    const std::string member = "\"node_step_ns\": 4.75";
    text.replace(text.find(member), member.size(), "\"node_step_ns\": -3.5");
    expect_generic(load_profile(folder_.write("bad", text)), Status::PROFILE_RANGE, "node_step_ns: has to lie between");
}

TEST_F(LoadProfile, RefusesAnotherSchemaAndEpoch) {
    std::string text = good_;
    text.replace(text.find("raywise-profile/2"), 17, "raywise-profile/9");
    expect_generic(load_profile(folder_.write("schema", text)), Status::PROFILE_SCHEMA, "raywise-profile/9");
    Profile old = sample_profile();
    old.epoch = calibration_epoch + 7;
    expect_generic(load_profile(folder_.write("epoch", to_json(old))), Status::PROFILE_EPOCH,
                   "it is " + std::to_string(calibration_epoch + 7));
}

TEST_F(LoadProfile, RefusesEachDifferenceOfTheMachine) {
    const std::vector<std::pair<std::string, std::function<void(Machine&)>>> changes = {
        {"machine.vendor: the profile has \"Other\", this machine \"", [](Machine& m) { m.vendor = "Other"; }},
        {"machine.family", [](Machine& m) { ++m.family; }},
        {"machine.model", [](Machine& m) { ++m.model; }},
        {"machine.stepping", [](Machine& m) { ++m.stepping; }},
        {"machine.instruction_set", [](Machine& m) { m.instruction_set = "avx9000"; }},
        {"machine.l1_bytes", [](Machine& m) { ++m.l1_bytes; }},
        {"machine.l2_bytes", [](Machine& m) { ++m.l2_bytes; }},
        {"machine.l3_bytes", [](Machine& m) { ++m.l3_bytes; }},
        {"machine.threads", [](Machine& m) { ++m.threads; }},
        {"machine.precision", [](Machine& m) { m.precision = "float32"; }},
    };
    for (const auto& [word, change] : changes) {
        Profile foreign = sample_profile();
        change(foreign.machine);
        expect_generic(load_profile(folder_.write("foreign.json", to_json(foreign))), Status::PROFILE_MACHINE, word);
    }
}

TEST_F(LoadProfile, DoesNotMindTheBrandAndTheHypervisor) {
    Profile profile = sample_profile();
    profile.machine.brand = "renamed by the firmware";
    profile.machine.virtualised = !profile.machine.virtualised;
    EXPECT_EQ(load_profile(folder_.write("same.json", to_json(profile))).status, Status::OK);
}

TEST_F(LoadProfile, ReadProfileTakesForeignOnesToo) {
    Profile foreign = sample_profile();
    foreign.machine.vendor = "Other";
    EXPECT_EQ(read_profile(folder_.write("foreign.json", to_json(foreign))).machine.vendor, "Other");
}

} // namespace
} // namespace raywise
