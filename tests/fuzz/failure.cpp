#include "fuzz/failure.h"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace raywise::fuzz {
namespace {

std::function<void()> context;

} // namespace

void fail(const char* format, ...) {
    std::fputs("\nraywise broke a promise: ", stderr);
    std::va_list arguments;
    va_start(arguments, format);
    std::vfprintf(stderr, format, arguments);
    va_end(arguments);
    std::fputs("\n", stderr);
    if (context) context();
    if (!is_tracing()) std::fputs("RAYWISE_FUZZ_TRACE=1 in the environment shows the calls that led here.\n", stderr);
    std::abort();
}

void set_context(std::function<void()> describe) { context = std::move(describe); }

bool is_tracing() {
    static const bool wanted = std::getenv("RAYWISE_FUZZ_TRACE") != nullptr;
    return wanted;
}

void trace(const char* format, ...) {
    if (!is_tracing()) return;
    std::va_list arguments;
    va_start(arguments, format);
    std::vfprintf(stderr, format, arguments);
    va_end(arguments);
    std::fputs("\n", stderr);
}

void demand_printable_message() {
    const char* message = rw_last_error_message();
    demand(*message != '\0', "something was refused without a word");
    for (; *message != '\0'; ++message) {
        demand(static_cast<unsigned char>(*message) >= 0x20 && *message != 0x7F, "a message holds a control character");
    }
}

bool Outcome::check(std::int32_t status) const {
    trace("%s: %s", call_.c_str(), status == RW_OK ? "ok" : rw_last_error_message());
    if (status == RW_OK) {
        if (must_fail()) fail("%s returned RW_OK, although an argument is wrong", call_.c_str());
        return true;
    }
    const bool known = status > 0 && status < RW_STATUS_COUNT;
    if (!known || !allowed_.test(static_cast<std::size_t>(status))) {
        fail("%s returned %d (%s), which its arguments give no reason for: %s", call_.c_str(), status,
             rw_status_text(status), rw_last_error_message());
    }
    if (rw_last_error_message()[0] == '\0') fail("%s returned %d without a message", call_.c_str(), status);
    return false;
}

} // namespace raywise::fuzz
