// Sums of doubles that never round (Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates", section 2). Exact as long as no product over- or underflows.
//
// This file is compiled with -ffp-contract=off: a product fused into the following sum would break the error-free transformations.
// std::fma is asked for where it is wanted.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace raywise {

// high + low is exact.
struct DoublePair {
    double high;
    double low;
};

// Knuth's two-sum.
inline DoublePair two_sum(double a, double b) {
    const double sum = a + b;
    const double b_part = sum - a;
    const double a_part = sum - b_part;
    return {sum, (a - a_part) + (b - b_part)};
}

inline DoublePair two_product(double a, double b) {
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

// Components do not overlap and grow in magnitude; zeros are left out.
template <std::size_t Capacity>
class Expansion {
public:
    void add(double value) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            const DoublePair sum = two_sum(value, components_[i]);
            value = sum.high;
            if (sum.low != 0.0) components_[kept++] = sum.low;
        }
        if (value != 0.0) components_[kept++] = value;
        size_ = kept;
    }

    void add_product(double a, double b) {
        const DoublePair product = two_product(a, b);
        if (product.low != 0.0) add(product.low);
        if (product.high != 0.0) add(product.high);
    }

    // From the smallest component up: the largest decides the sign, the rest refine the value.
    double value() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < size_; ++i) sum += components_[i];
        return sum;
    }

private:
    std::array<double, Capacity> components_;
    std::size_t size_ = 0;
};

} // namespace raywise
