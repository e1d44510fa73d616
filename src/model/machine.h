// What identifies a machine as far as costs depend on it.
#pragma once

#include <cstdint>
#include <string>

namespace raywise {

struct Machine {
    std::string vendor; // "AuthenticAMD"
    std::string brand;  // for people
    unsigned family = 0;
    unsigned model = 0;
    unsigned stepping = 0;
    std::string instruction_set; // what the kernels use, as instruction_set() names it: "AVX2", "SSE4", "NEON" ...
    std::uint64_t l1_bytes = 0;
    std::uint64_t l2_bytes = 0;
    std::uint64_t l3_bytes = 0;
    unsigned threads = 0;              // usable by this process: affinity and cgroup included
    std::string precision = "float64"; // of the decisive tests
    bool virtualised = false;          // told, not compared

    // Names the profile's file: lower case letters, digits and '-', e.g. "authenticamd-26-2-1-avx3-l3-32m-t2".
    std::string key() const;
};

// This machine. Reads the CPU's own words and the system's files; no clock, no measurement.
Machine look_at_machine();

// The same as it was when first asked for.
const Machine& this_machine();

} // namespace raywise
