// Directions are scaled by a power of two, so that their largest component lies in [1, 2): then one error bound serves all rays, and
// products of tiny or huge directions neither under- nor overflow.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace raywise {

// Between the caller's t and t in units of the scaled direction. Both conversions are exact, but for results beyond the normal numbers.
class DirectionScale {
public:
    DirectionScale() = default;
    // largest: of the magnitudes of the caller's direction; finite, not zero.
    explicit DirectionScale(double largest) {
        std::uint64_t bits;
        std::memcpy(&bits, &largest, sizeof bits);
        exponent_ = static_cast<int>(bits >> 52) - 1023; // of a normal number
        if (std::abs(exponent_) <= 1000) {               // so that 2^exponent and 2^-exponent are normal numbers both
            length_ = power_of_two(exponent_);
            inverse_length_ = power_of_two(-exponent_);
        } else {
            exponent_ = std::ilogb(largest);
        }
    }

    // length: a power of two, of length() of another.
    static DirectionScale of_length(double length) {
        DirectionScale scale;
        std::uint64_t bits;
        std::memcpy(&bits, &length, sizeof bits);
        scale.exponent_ = static_cast<int>(bits >> 52) - 1023;
        scale.length_ = length;
        scale.inverse_length_ = power_of_two(-scale.exponent_);
        return scale;
    }

    // By multiplication where the power of two and its inverse are normal numbers: ldexp takes ten times as long.
    double to_caller(double scaled_t) const {
        return is_normal() ? scaled_t * inverse_length_ : std::ldexp(scaled_t, -exponent_);
    }
    double from_caller(double t) const { return is_normal() ? t * length_ : std::ldexp(t, exponent_); }

    bool is_normal() const { return length_ != 0.0; }
    double length() const { return length_; }                 // 0 where it is not normal
    double inverse_length() const { return inverse_length_; } // where it is normal

private:
    static double power_of_two(int exponent) {
        const auto bits = static_cast<std::uint64_t>(exponent + 1023) << 52;
        double power;
        std::memcpy(&power, &bits, sizeof power);
        return power;
    }

    int exponent_ = 0;
    double length_ = 0.0; // 0: not a normal number, or its inverse is not
    double inverse_length_ = 0.0;
};

} // namespace raywise
