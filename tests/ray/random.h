// Random numbers for tests of rays.
#pragma once

#include "base/vec.h"

#include <cstdint>
#include <random>

namespace raywise {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    double number() { return 2.0 * (static_cast<double>(engine_() >> 11) * 0x1p-53) - 1.0; } // in [-1, 1)
    Vec3 point() {
        const double x = number();
        const double y = number();
        return {x, y, number()};
    }
    std::uint64_t integer() { return engine_(); }

private:
    std::mt19937_64 engine_;
};

} // namespace raywise
