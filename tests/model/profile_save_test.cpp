// A reader sees the old profile or the new one, and a failure leaves nothing behind.
#include "model/profile.h"
#include "profile_fixture.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <limits>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace raywise {
namespace {

Status save_status(const Profile& profile, const std::filesystem::path& path) {
    try {
        save_profile(profile, path);
        return Status::OK;
    } catch (const Error& error) {
        return error.status();
    }
}

std::size_t entries(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

// No file may grow past so many bytes: a disk that is full, even for the superuser.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        rlimit limit = before_;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    rlimit before_{};
    void (*handler_)(int) = nullptr;
};

class SaveProfile : public testing::Test {
protected:
    TemporaryFolder folder_;
    const Profile profile_ = sample_profile();
};

TEST_F(SaveProfile, WritesWhatLoadReads) {
    save_profile(profile_, folder_ / "p.json");
    EXPECT_EQ(load_profile(folder_ / "p.json").status, Status::OK);
    EXPECT_EQ(text_of(folder_ / "p.json"), to_json(profile_));
    EXPECT_EQ(entries(folder_.path()), 1u);
    struct stat facts {};
    ASSERT_EQ(::stat((folder_ / "p.json").c_str(), &facts), 0);
    EXPECT_EQ(facts.st_mode & 0777u, 0644u);
}

TEST_F(SaveProfile, ReplacesAnOldFile) {
    folder_.write("p.json", "old");
    save_profile(profile_, folder_ / "p.json");
    EXPECT_EQ(text_of(folder_ / "p.json"), to_json(profile_));
}

TEST_F(SaveProfile, MakesFolders) {
    const mode_t mask = ::umask(0);
    save_profile(profile_, folder_ / "a/b/p.json");
    ::umask(mask);
    EXPECT_EQ(load_profile(folder_ / "a/b/p.json").status, Status::OK);
    struct stat facts {};
    ASSERT_EQ(::stat((folder_ / "a").c_str(), &facts), 0);
    EXPECT_EQ(facts.st_mode & 0777u, 0755u);
}

TEST_F(SaveProfile, KeepsALinkALink) {
    folder_.write("real.json", "old");
    std::filesystem::create_symlink(folder_ / "real.json", folder_ / "link.json");
    save_profile(profile_, folder_ / "link.json");
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link.json"));
    EXPECT_EQ(text_of(folder_ / "real.json"), to_json(profile_));
}

TEST_F(SaveProfile, AFullDiskKeepsTheOldFileAndLeavesNothing) {
    folder_.write("p.json", "old");
    {
        const FileSizeLimit limit(100);
        EXPECT_EQ(save_status(profile_, folder_ / "p.json"), Status::ERROR_FILE_UNREADABLE);
        EXPECT_EQ(save_status(profile_, folder_ / "new/folder/p.json"), Status::ERROR_FILE_UNREADABLE);
    }
    EXPECT_EQ(text_of(folder_ / "p.json"), "old");
    EXPECT_EQ(entries(folder_.path()), 1u);
}

TEST_F(SaveProfile, NeverTakesThePlaceOfAFolderOrADevice) {
    std::filesystem::create_directory(folder_ / "taken");
    EXPECT_EQ(save_status(profile_, folder_ / "taken"), Status::ERROR_FILE_UNREADABLE);
    EXPECT_EQ(save_status(profile_, "/dev/null"), Status::ERROR_FILE_UNREADABLE);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
    EXPECT_EQ(entries(folder_.path()), 1u);
}

TEST_F(SaveProfile, RefusesImpossiblePlaces) {
    folder_.write("file", "");
    EXPECT_EQ(save_status(profile_, folder_ / "file/below/p.json"), Status::ERROR_FILE_UNREADABLE);
    EXPECT_EQ(save_status(profile_, ""), Status::ERROR_FILE_UNREADABLE);
    EXPECT_EQ(save_status(profile_, folder_ / std::string(300, 'x')), Status::ERROR_FILE_UNREADABLE);
    EXPECT_EQ(entries(folder_.path()), 1u);
}

TEST_F(SaveProfile, DoesNotWriteWhatItWouldNotRead) {
    Profile bad = profile_;
    bad.constants.node_step_ns = -1.0;
    EXPECT_EQ(save_status(bad, folder_ / "p.json"), Status::PROFILE_RANGE);
    bad.constants.node_step_ns = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(save_status(bad, folder_ / "p.json"), Status::PROFILE_MALFORMED);
    EXPECT_EQ(entries(folder_.path()), 0u);
}

} // namespace
} // namespace raywise
