// How a fuzzer says that a promise was broken: it explains itself on stderr and aborts, which libFuzzer takes for a crash.
#pragma once

#include "raywise/raywise.h"

#include <bitset>
#include <cstdint>
#include <functional>
#include <string>

namespace raywise::fuzz {

// printf's arguments. Prints what `set_context` was given, too.
[[noreturn]] __attribute__((format(printf, 1, 2))) void fail(const char* format, ...);

// Describes the state of things on stderr when something fails, e.g. the meshes; null: nothing to describe.
void set_context(std::function<void()> describe);

// One line on stderr per call of the library, when RAYWISE_FUZZ_TRACE is set: what a reproducer does.
__attribute__((format(printf, 1, 2))) void trace(const char* format, ...);
bool is_tracing();

inline void demand(bool holds, const char* what) {
    if (!holds) fail("%s", what);
}

// Messages go to terminals, which obey control characters: whatever a file holds, there may be none in them. Looks at the
// thread's last error message.
void demand_printable_message();

// The statuses the header allows for one call with these arguments.
class Outcome {
public:
    explicit Outcome(std::string call) : call_(std::move(call)) {}

    // An argument is wrong: RW_OK is then a failure, this status and those of other wrong arguments are not.
    Outcome& fails_if(bool wrong, std::int32_t status) {
        if (wrong) {
            allowed_.set(static_cast<std::size_t>(status));
            may_succeed_ = false;
        }
        return *this;
    }
    // May happen, or not.
    Outcome& may_fail_if(bool possible, std::int32_t status) {
        if (possible) allowed_.set(static_cast<std::size_t>(status));
        return *this;
    }
    Outcome& add(const Outcome& other) {
        allowed_ |= other.allowed_;
        may_succeed_ = may_succeed_ && other.may_succeed_;
        return *this;
    }

    bool must_fail() const { return !may_succeed_; }
    // Checks what came back. Returns whether it was RW_OK.
    bool check(std::int32_t status) const;

private:
    std::string call_;
    std::bitset<RW_STATUS_COUNT> allowed_;
    bool may_succeed_ = true;
};

} // namespace raywise::fuzz
