// Random numbers that are the same everywhere; the standard library's distributions are not.
#pragma once

#include "base/split_mix.h"
#include "base/vec.h"

#include <cmath>
#include <cstdint>

namespace raywise::workloads {

// Any seed will do.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        state_ += split_mix_step;
        return mix(state_);
    }
    // In [0, 1)
    double uniform() { return unit_number(bits()); }
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

    static std::uint64_t mix(std::uint64_t x) { return split_mix(x); }

private:
    std::uint64_t state_;
};

} // namespace raywise::workloads
