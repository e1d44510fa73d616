#include "commands.h"
#include "model/profile.h"

#include <cstdio>

namespace raywise::calibration {

// A named file is shown whichever machine it is of; without a name, what the library would use here.
int run_show(const ShowOptions& options) {
    Profile profile;
    try {
        profile = options.file.empty() ? find_profile() : read_profile(options.file);
    } catch (const Error& error) {
        complain(error.what());
        return exit_failed;
    }
    if (options.json) {
        std::fputs(to_json(profile).c_str(), stdout);
        return exit_ok;
    }
    std::fputs(to_text(profile).c_str(), stdout);
    std::string difference;
    if (profile.source != ProfileSource::generic && check_machine(profile, this_machine(), difference) != Status::OK) {
        std::printf("\nNot valid here: %s\n", difference.c_str());
    }
    return exit_ok;
}

} // namespace raywise::calibration
