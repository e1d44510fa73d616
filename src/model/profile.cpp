#include "model/profile.h"

#include <string>

namespace raywise {
namespace {

std::string shown(const std::string& value) { return "\"" + value + "\""; }
std::string shown(std::uint64_t value) { return std::to_string(value); }

// Notes the first difference.
template <class T>
void compare(const char* member, const T& profile, const T& here, std::string& difference) {
    if (!difference.empty() || profile == here) return;
    difference =
        std::string("machine.") + member + ": the profile has " + shown(profile) + ", this machine " + shown(here);
}

} // namespace

Status check_machine(const Profile& profile, const Machine& here, std::string& reason) {
    const Machine& there = profile.machine;
    std::string difference;
    compare("vendor", there.vendor, here.vendor, difference);
    compare("family", there.family, here.family, difference);
    compare("model", there.model, here.model, difference);
    compare("stepping", there.stepping, here.stepping, difference);
    compare("instruction_set", there.instruction_set, here.instruction_set, difference);
    compare("l1_bytes", there.l1_bytes, here.l1_bytes, difference);
    compare("l2_bytes", there.l2_bytes, here.l2_bytes, difference);
    compare("l3_bytes", there.l3_bytes, here.l3_bytes, difference);
    compare("threads", there.threads, here.threads, difference);
    compare("precision", there.precision, here.precision, difference);
    if (difference.empty()) return Status::OK;
    reason = difference;
    return Status::PROFILE_MACHINE;
}

} // namespace raywise
