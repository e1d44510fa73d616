// Random numbers that are the same everywhere; the standard library's distributions are not.
#pragma once

#include "base/vec.h"

#include <cmath>
#include <cstdint>

namespace raywise::workloads {

// SplitMix64 (Steele, Lea, Flood 2014): a counter and a mixing function. Good enough for scenes, and any seed will do.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        state_ += 0x9E3779B97F4A7C15u;
        return mix(state_);
    }
    // In [0, 1)
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    Vec3 in_cube() {
        const double x = uniform(), y = uniform(), z = uniform();
        return {x, y, z};
    }
    // On the unit sphere: points of the ball, pushed outwards. No sine that platforms could disagree about.
    Vec3 on_sphere() {
        for (;;) {
            const Vec3 p = in_cube() * 2.0 - 1.0;
            const double square = glm::dot(p, p);
            if (square > 1e-6 && square <= 1.0) return p / std::sqrt(square);
        }
    }
    Vec2 in_disc() {
        for (;;) {
            const double x = uniform(-1.0, 1.0), y = uniform(-1.0, 1.0);
            if (x * x + y * y <= 1.0) return {x, y};
        }
    }

    static std::uint64_t mix(std::uint64_t x) {
        x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
        x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
        return x ^ (x >> 31);
    }

private:
    std::uint64_t state_;
};

} // namespace raywise::workloads
