// Versions, statuses and the last error message.
#include "guard.h"
#include "handles.h"

#include <cstring>

// The same numbers inside and outside.
#define RW_STATUS(name, value, text) \
    static_assert(RW_##name == value && static_cast<std::int32_t>(raywise::Status::name) == value);
#include "base/status_list.def"
#undef RW_STATUS

namespace raywise::capi {
namespace {

thread_local char last_error[1024] = "";

} // namespace

void set_last_error(const char* message) noexcept {
    std::strncpy(last_error, message, sizeof last_error - 1);
    last_error[sizeof last_error - 1] = '\0';
}

} // namespace raywise::capi

using namespace raywise::capi;

extern "C" {

std::int32_t rw_version(std::uint32_t* major, std::uint32_t* minor, std::uint32_t* patch) {
    return guard([&] {
        if (major != nullptr) *major = RW_VERSION_MAJOR;
        if (minor != nullptr) *minor = RW_VERSION_MINOR;
        if (patch != nullptr) *patch = RW_VERSION_PATCH;
    });
}

std::int32_t rw_abi_version(std::uint32_t* abi) {
    return guard([&] { required(abi, "abi") = RW_ABI_VERSION; });
}

const char* rw_status_text(std::int32_t status) {
    switch (status) {
#define RW_STATUS(name, value, text) \
    case value:                      \
        return text;
#include "base/status_list.def"
#undef RW_STATUS
        default:
            return "a status this version of the library does not know";
    }
}

const char* rw_last_error_message(void) { return last_error; }

} // extern "C"
