// Points and directions as integers, in which the signs that decide a hit are computed without any rounding.
//
// Every double is an integer times a power of two. With one power for all coordinates of a question and one for the direction,
// differences, products and sums stay integers. Boost.Multiprecision's cpp_int keeps them on the stack and allocates nothing.
#pragma once

#include "base/vec.h"

#include <boost/multiprecision/cpp_int.hpp>

#include <cstdint>
#include <cstring>
#include <initializer_list>

namespace raywise {

// Room for the widest value asked for: coordinates are multiples of 2^-1074 below 2^1024, so their differences take 2,099 bits;
// a prepared direction's components are multiples of 2^-552 below 2 (ExactRay::smallest_direction), 553 bits. A determinant
// is a sum of six products of two differences and a direction: 2 * 2,099 + 553 + 3 bits; crossings.cpp adds six of those. A
// volume is a sum of six products of three differences: 3 * 2,099 + 3 bits. A polygon's normal is a sum of two products of two
// differences for each of less than 2^64 corners.
using WideInteger = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<6400, 6400, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;

struct WideVec3 {
    WideInteger x;
    WideInteger y;
    WideInteger z;
};

inline WideVec3 operator-(const WideVec3& a, const WideVec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline WideVec3 operator+(const WideVec3& a, const WideVec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

inline WideVec3 cross(const WideVec3& a, const WideVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline WideInteger dot(const WideVec3& a, const WideVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// A unit 2^exponent of which given numbers are multiples, as large as possible so that the integers stay short.
class BinaryUnit {
    __extension__ using Int128 = __int128;

public:
    BinaryUnit(std::initializer_list<Vec3> vectors) : BinaryUnit(vectors.begin(), vectors.end()) {}

    template <class Iterator>
    BinaryUnit(Iterator begin, Iterator end) {
        for (; begin != end; ++begin) {
            const Vec3& v = *begin;
            for (int axis = 0; axis < 3; ++axis) {
                const Parts parts = parts_of(v[axis]);
                if (parts.mantissa != 0 && parts.exponent < exponent_) exponent_ = parts.exponent;
            }
        }
    }

    // x / 2^exponent, for a number the unit was made for.
    WideInteger count(double x) const {
        const Parts parts = parts_of(x);
        if (parts.mantissa == 0) return 0;
        const auto shift = static_cast<unsigned>(parts.exponent - exponent_);
        // Nearly always there is room for the shift in 128 bits, which takes a fraction of the time.
        if (shift <= 70) return static_cast<Int128>(parts.mantissa) * (Int128{1} << shift);
        return WideInteger(parts.mantissa) << shift;
    }
    WideVec3 count(const Vec3& v) const { return {count(v.x), count(v.y), count(v.z)}; }

    int exponent() const { return exponent_; }

private:
    // x = mantissa * 2^exponent, with an odd mantissa.
    struct Parts {
        std::int64_t mantissa;
        int exponent;
    };
    static Parts parts_of(double x) {
        std::uint64_t bits;
        std::memcpy(&bits, &x, sizeof bits);
        const auto biased = static_cast<int>(bits >> 52 & 0x7FF);
        auto mantissa = static_cast<std::int64_t>(bits & 0xFFFFFFFFFFFFF);
        if (biased != 0) mantissa |= std::int64_t{1} << 52; // a normal number
        if (mantissa == 0) return {0, 0};
        const int zeros = __builtin_ctzll(static_cast<unsigned long long>(mantissa));
        mantissa >>= zeros;
        return {bits >> 63 != 0 ? -mantissa : mantissa, (biased != 0 ? biased : 1) - 1075 + zeros};
    }

    int exponent_ = 1024;
};

// The bits of a value; 0 for 0.
inline int bit_length(const WideInteger& value) {
    return value.is_zero() ? 0 : static_cast<int>(boost::multiprecision::msb(abs(value))) + 1;
}

// value * 2^-shift as a double, within one unit in the last place; far below the range of doubles it becomes zero.
inline double scaled_down(const WideInteger& value, int shift) {
    // Cut to 64 bits first: what is left converts with one rounding.
    const int cut = bit_length(value) > 64 ? bit_length(value) - 64 : 0;
    const auto top = static_cast<std::uint64_t>(WideInteger(abs(value) >> static_cast<unsigned>(cut)));
    const double magnitude = std::ldexp(static_cast<double>(top), cut - shift);
    return value.sign() < 0 ? -magnitude : magnitude;
}

} // namespace raywise
