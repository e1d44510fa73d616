// Calibration profiles.
#include "convert.h"
#include "guard.h"

using namespace raywise;
using namespace raywise::capi;

extern "C" {

std::int32_t rw_profile_load(const char* path, rw_profile** profile) {
    return guard([&] {
        rw_profile*& out = required(profile, "profile");
        auto loaded = path != nullptr ? std::make_shared<const Profile>(load_profile(path)) : kept_profile();
        if (loaded->status != Status::OK) set_last_error(loaded->reason.c_str());
        const Status status = loaded->status;
        out = new rw_profile(std::move(loaded));
        return status;
    });
}

std::int32_t rw_profile_retain(const rw_profile* profile) {
    return guard([&] { retain(profile, "profile"); });
}

std::int32_t rw_profile_release(const rw_profile* profile) {
    return guard([&] { release(profile); });
}

std::int32_t rw_profile_inspect(const rw_profile* profile, rw_profile_info* info) {
    return guard([&] {
        const Profile& p = *required(profile, "profile").value;
        rw_profile_info facts{};
        facts.source = static_cast<std::int32_t>(p.source);
        facts.status = static_cast<std::int32_t>(p.status);
        facts.epoch = p.epoch;
        facts.path = p.path.c_str();
        facts.machine = profile->machine_key.c_str();
        facts.date = p.provenance.date.c_str();
        facts.tool = p.provenance.tool.c_str();
        facts.spread = p.provenance.spread;
        facts.threads = p.machine.threads;
        write_struct(info, "info", facts);
    });
}

std::int32_t rw_profile_text(const rw_profile* profile, std::int32_t format, char* buffer, std::uint64_t capacity,
                             std::uint64_t* needed) {
    return guard([&] {
        const Profile& p = *required(profile, "profile").value;
        return write_text(is_json(format) ? to_json(p) : to_text(p), buffer, capacity, needed);
    });
}

} // extern "C"
