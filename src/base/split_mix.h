// SplitMix64 (Steele, Lea, Flood 2014): a counter and a mixing function. Small, and the same on every platform, which the standard library's
// distributions are not. Random numbers of scenes and samples are made of it.
#pragma once

#include <cstdint>

namespace raywise {

// Counters that are so far apart are mixed to numbers that look independent.
inline constexpr std::uint64_t split_mix_step = 0x9E3779B97F4A7C15u;

constexpr std::uint64_t split_mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

// In [0, 1).
constexpr double unit_number(std::uint64_t mixed) { return static_cast<double>(mixed >> 11) * 0x1p-53; }

} // namespace raywise
