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
    std::string instruction_set; // the level the kernels dispatch to: "x86-64", "avx2", "avx512", "aarch64"
    std::uint64_t l1_bytes = 0;
    std::uint64_t l2_bytes = 0;
    std::uint64_t l3_bytes = 0;
    unsigned threads = 0;              // usable by this process: affinity and cgroup included
    std::string precision = "float64"; // of the decisive tests
    bool virtualised = false;          // told, not compared

    // Names the profile's file: lower case letters, digits and '-', e.g. "authenticamd-26-2-1-x86-64-l3-32m-t2".
    std::string key() const;
};

// This machine. Reads the CPU's own words and the system's files; no clock, no measurement.
const Machine& this_machine();

} // namespace raywise
