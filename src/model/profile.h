// A calibration profile: the constants with the machine, tool and date they were measured on, and its file.
//
// Files are distrusted: at most 1 MiB, every member checked for type and range, all or nothing. Anything wrong means
// another file or the generic constants, and a status that says why.
#pragma once

#include "base/error.h"
#include "model/constants.h"
#include "model/machine.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace raywise {

// Values as RW_PROFILE_SOURCE_* in raywise.h.
enum class ProfileSource {
    generic = 0,
    path = 1,
    environment = 2,
    user = 3,
    system = 4
};

struct Provenance {
    std::string tool;     // "raywise-calibrate 0.2.0"
    std::string command;  // as typed
    std::string date;     // ISO 8601, UTC
    std::string mode;     // "quick" or "full"
    double spread = 0.0;  // relative spread of repeated timings
    double seconds = 0.0; // how long measuring took
};

struct Profile {
    unsigned epoch = calibration_epoch;
    Machine machine;
    Provenance provenance;
    MachineConstants constants;

    // Where it came from; not part of the file.
    ProfileSource source = ProfileSource::generic;
    std::string path;
    // Why a file that comes before this one was passed over (OK when none was), in a status and in words: "PATH: what is wrong".
    // What is used instead is this profile, which its source tells.
    Status status = Status::OK;
    std::string reason;
};

// The compiled-in constants, from profiles/generic.json.
const Profile& generic_profile();

// Reads one file, which has to fit this machine. On a fault returns the generic profile with status and reason set.
// Never throws but std::bad_alloc.
Profile load_profile(const std::filesystem::path& path);

// Reads one file, of whatever machine. Throws Error with a PROFILE_ status.
Profile read_profile(const std::filesystem::path& path);

// Where profiles are looked for. Empty: not there.
struct ProfilePlaces {
    std::string environment; // RAYWISE_CALIBRATION: a path, or "builtin" for the generic constants
    std::filesystem::path user;
    std::filesystem::path system;
};

// First valid wins: RAYWISE_CALIBRATION, the user's cache folder, the system's folder, the generic constants. status
// and reason tell of the first file that was there (or named by RAYWISE_CALIBRATION) and could not be used.
// Never throws but std::bad_alloc.
Profile find_profile();
Profile find_profile(const ProfilePlaces& places);

// What find_profile() found when this was first called. Kept for as long as the process lives, so that whoever needs constants
// need not read a file; a call that runs out of memory keeps nothing, and the next one looks again.
const std::shared_ptr<const Profile>& kept_profile();

// The profile as JSON text, and back: what is read and written again is the same text. parse throws Error with a
// PROFILE_ status; it checks everything but the machine.
std::string to_json(const Profile& profile);
Profile parse_profile(const std::string& text);

// Where its constants came from, for people.
std::string source_text(const Profile& profile);

// As text for people: fits 100 columns.
std::string to_text(const Profile& profile);

// OK, or PROFILE_MACHINE with the difference in `reason`.
Status check_machine(const Profile& profile, const Machine& here, std::string& reason);

// Where find_profile() looks, and where calibration writes. The user's is empty when neither XDG_CACHE_HOME nor HOME is
// an absolute path.
std::filesystem::path user_profile_path(const Machine& machine);
std::filesystem::path system_profile_path(const Machine& machine);

// Writes through a temporary file and a rename, so that a reader sees the old file or the new one; folders that are
// missing are made, and unmade when it fails. For calibration: the library itself never writes. Throws Error with
// ERROR_FILE_UNREADABLE, or with a PROFILE_ status when the profile could not be read back.
void save_profile(const Profile& profile, const std::filesystem::path& path);

} // namespace raywise
