// The subcommands of raywise-calibrate: what each needs to know, and what it returns to the shell.
#pragma once

#include <cstdint>
#include <string>

namespace raywise::calibration {

// Exit codes, as --help lists them.
enum ExitCode {
    exit_ok = 0,
    exit_failed = 1,    // something failed; check: no valid profile
    exit_usage = 2,     // the command line is wrong
    exit_too_noisy = 3, // measured, but not saved
};

struct MeasureOptions {
    bool full = false;
    double time_limit = 0.0; // seconds; 0: the mode's own
    std::uint32_t threads = 1;
    std::string output; // empty: the user's profile
    bool system = false;
    bool force = false;
    bool json = false;
    bool quiet = false;
    std::string command; // as typed
};
int run_measure(const MeasureOptions& options);

struct ShowOptions {
    std::string file; // empty: the profile in use
    bool json = false;
};
int run_show(const ShowOptions& options);

struct CheckOptions {
    std::string file; // empty: where the library looks
};
int run_check(const CheckOptions& options);

struct ExplainOptions {
    std::string mesh;
    std::uint64_t rays = 0; // RW_RAYS_UNKNOWN when not known; 0: a table of many numbers
    std::int32_t kind = 0;  // RW_RAYS_
    bool json = false;
};
int run_explain(const ExplainOptions& options);

// "raywise-calibrate 0.2.0"
std::string tool_name();

// A line on standard error: "raywise-calibrate: message".
void complain(const std::string& message);

} // namespace raywise::calibration
