#include "commands.h"
#include "model/profile.h"

#include <cstdio>

namespace raywise::calibration {

int run_check(const CheckOptions& options) {
    const Profile profile = options.file.empty() ? find_profile() : load_profile(options.file);
    if (profile.status != Status::OK) std::printf("passed over: %s\n", profile.reason.c_str());
    if (profile.source == ProfileSource::generic) {
        std::printf("no valid profile for this machine (%s); generic constants are used\n",
                    this_machine().key().c_str());
        return exit_failed;
    }
    std::printf("valid: %s (%s, %s, spread %.1f %%)\n", profile.path.c_str(), profile.provenance.mode.c_str(),
                profile.provenance.date.c_str(), profile.provenance.spread * 100.0);
    return exit_ok;
}

} // namespace raywise::calibration
