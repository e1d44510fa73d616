// Random numbers of the sweep: the same for the same seed everywhere.
#pragma once

#include "base/vec.h"

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>

namespace raywise::sweep {

// Of a name, to seed with: FNV-1a, as std::hash differs between libraries.
inline std::uint64_t hash_of(const std::string& text) {
    std::uint64_t hash = 1469598103934665603u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    return hash;
}

class Random {
public:
    // One stream for each list of numbers, e.g. seed, scene and block.
    Random(std::initializer_list<std::uint64_t> parts) {
        std::uint64_t state = 0;
        for (const std::uint64_t part : parts) state = mixed(state ^ mixed(part));
        engine_.seed(state);
    }

    std::uint64_t bits() { return engine_(); }
    std::uint64_t below(std::uint64_t count) { return engine_() % count; }
    bool one_in(std::uint64_t count) { return below(count) == 0; }
    double number(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    Vec3 in_cube() {
        const double x = number(-1.0, 1.0);
        const double y = number(-1.0, 1.0);
        return {x, y, number(-1.0, 1.0)};
    }
    // Of unit length, all directions alike.
    Vec3 direction() {
        for (;;) {
            const Vec3 p = in_cube();
            const double length = std::sqrt(glm::dot(p, p));
            if (length <= 1.0 && length > 0.01) return p / length;
        }
    }

private:
    // The finaliser of SplitMix64 (Steele, Lea, Flood 2014).
    static std::uint64_t mixed(std::uint64_t x) {
        x += 0x9e3779b97f4a7c15u;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }

    std::mt19937_64 engine_;
};

} // namespace raywise::sweep
