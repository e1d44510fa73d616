// What a fuzzer's bytes are turned into: choices, and numbers of the kinds that break geometry.
#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

namespace raywise::fuzz {

class Input {
public:
    Input(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {
        // Everything of one input stands on one lattice, so that corners, edges and planes coincide; where it lies and how fine
        // it is decides which bits are lost.
        static constexpr std::array<int, 8> steps = {0, 0, 0, -1, -10, -140, 60, 120};
        static constexpr std::array<double, 6> offsets = {0.0, 0.0, 0.0, 1000.0, 5e6, -16777216.0};
        step_ = std::ldexp(1.0, bytes_.PickValueInArray(steps));
        offset_ = bytes_.PickValueInArray(offsets);
    }

    bool is_empty() { return bytes_.remaining_bytes() == 0; }

    template <class T>
    T between(T lowest, T highest) {
        return bytes_.ConsumeIntegralInRange<T>(lowest, highest);
    }
    std::size_t below(std::size_t count) { return between<std::size_t>(0, count - 1); }
    bool one_in(int count) { return between(1, count) == count; } // false once the bytes have run out
    template <class T, std::size_t N>
    T pick(const T (&values)[N]) {
        return values[below(N)];
    }
    template <class T>
    T raw() {
        T value{};
        bytes_.ConsumeData(&value, sizeof value);
        return value;
    }
    std::string text(std::size_t longest) { return bytes_.ConsumeRandomLengthString(longest); }

    double lattice() { return offset_ + step_ * between<int>(-4, 4); }

    // A coordinate that a mesh may have.
    double coordinate() {
        const auto kind = between<int>(0, 15);
        if (kind == 15) return finite(static_cast<double>(raw<float>()));
        if (kind == 14) return finite(raw<double>());
        if (kind == 13) return pick(extreme_coordinates);
        if (kind == 12) return std::nextafter(lattice(), lattice());
        if (kind == 11) return lattice() / 3.0;
        return lattice();
    }

    // Any number, also one that a mesh may not have.
    double number() { return one_in(3) ? pick(odd_numbers) : coordinate(); }

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    static constexpr double extreme_coordinates[] = {
        -0.0, 1e-38, -1e-38, 1e-45,   4.9e-324, -4.9e-324, 2.2e-308,  1e-200, 1e-100,   1e-20,         1e20,
        1e30, -1e30, 3.4e38, -3.4e38, 16777217, 1e-7,      1.0000001, 0.1,    0x1p-149, 0x1.fffffep127};
    static constexpr double odd_numbers[] = {nan,   -nan,   infinity, -infinity, 3.5e38, -1e39, 1e300,
                                             1e308, -1e308, 4.9e-324, 0.0,       -0.0,   1e-320};

    double finite(double value) {
        return std::fabs(value) <= static_cast<double>(std::numeric_limits<float>::max()) ? value : lattice();
    }

    FuzzedDataProvider bytes_;
    double step_;
    double offset_;
};

} // namespace raywise::fuzz
