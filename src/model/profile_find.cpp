// Where profiles are looked for, and which one is taken.
#include "model/profile.h"

#include <cstdlib>
#include <utility>

namespace raywise {
namespace {

// Not for programs that run with another user's rights: whoever starts them has no say in which files they read.
std::string environment(const char* name) {
#ifdef __GLIBC__
    const char* value = ::secure_getenv(name);
#else
    const char* value = std::getenv(name);
#endif
    return value ? value : "";
}

// The profile of that file when it can be used here; otherwise notes why not, unless something was noted before.
bool take(const std::filesystem::path& path, ProfileSource source, Profile& profile, Status& status,
          std::string& reason) {
    try {
        Profile read = read_profile(path);
        std::string difference;
        const Status fit = check_machine(read, this_machine(), difference);
        if (fit != Status::OK) throw Error(fit, path.string() + ": " + difference);
        profile = std::move(read);
        profile.source = source;
        return true;
    } catch (const Error& error) {
        if (status == Status::OK) {
            status = error.status();
            reason = error.what();
        }
        return false;
    }
}

bool is_not_there(const std::filesystem::path& path) {
    std::error_code error;
    return !std::filesystem::exists(std::filesystem::symlink_status(path, error));
}

} // namespace

Profile load_profile(const std::filesystem::path& path) {
    Profile profile = generic_profile();
    Status status = Status::OK;
    std::string reason;
    take(path, ProfileSource::path, profile, status, reason);
    profile.status = status;
    profile.reason = reason;
    return profile;
}

Profile find_profile(const ProfilePlaces& places) {
    Profile profile = generic_profile();
    if (places.environment == "builtin") return profile;
    Status status = Status::OK;
    std::string reason;
    const auto use = [&](const std::filesystem::path& path, ProfileSource source) {
        return take(path, source, profile, status, reason);
    };
    const auto use_if_there = [&](const std::filesystem::path& path, ProfileSource source) {
        return !path.empty() && !is_not_there(path) && use(path, source);
    };
    // A file that was asked for by name is missed when it is not there; the others are not.
    static_cast<void>((!places.environment.empty() && use(places.environment, ProfileSource::environment)) ||
                      use_if_there(places.user, ProfileSource::user) ||
                      use_if_there(places.system, ProfileSource::system));
    profile.status = status;
    profile.reason = reason;
    return profile;
}

Profile find_profile() {
    const Machine& here = this_machine();
    return find_profile({environment("RAYWISE_CALIBRATION"), user_profile_path(here), system_profile_path(here)});
}

const std::shared_ptr<const Profile>& kept_profile() {
    // Never freed: threads may go on, and functions registered with atexit run, when objects with static storage are gone.
    static const auto& kept = *new std::shared_ptr<const Profile>(std::make_shared<const Profile>(find_profile()));
    return kept;
}

std::filesystem::path user_profile_path(const Machine& machine) {
    // Relative paths are to be ignored, says the XDG base directory specification.
    std::filesystem::path folder = environment("XDG_CACHE_HOME");
    if (!folder.is_absolute()) {
        const std::filesystem::path home = environment("HOME");
        if (!home.is_absolute()) return {};
        folder = home / ".cache";
    }
    return folder / "raywise" / (machine.key() + ".json");
}

std::filesystem::path system_profile_path(const Machine& machine) {
    return std::filesystem::path("/etc/raywise") / (machine.key() + ".json");
}

} // namespace raywise
