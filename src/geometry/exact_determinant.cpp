#include "geometry/exact_determinant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

// This file and everything that includes triangle_test.h is compiled with -ffp-contract=off: a product fused into the
// following sum would break the error-free transformations below. std::fma is asked for where it is wanted.

namespace raywise {
namespace {

struct Pair {
    double high;
    double low; // high + low is exact
};

// Knuth's two-sum.
Pair two_sum(double a, double b) {
    const double sum = a + b;
    const double b_part = sum - a;
    const double a_part = sum - b_part;
    return {sum, (a - a_part) + (b - b_part)};
}

Pair two_product(double a, double b) {
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

// A sum of doubles that never rounds: components are non-overlapping and grow in magnitude; zeros are left out.
class Expansion {
public:
    void add(double value) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            const Pair sum = two_sum(value, components_[i]);
            value = sum.high;
            if (sum.low != 0.0) components_[kept++] = sum.low;
        }
        if (value != 0.0) components_[kept++] = value;
        size_ = kept;
    }

    void add_product(double a, double b) {
        if (a == 0.0 || b == 0.0) return;
        const Pair product = two_product(a, b);
        add(product.low);
        add(product.high);
    }

    // From the smallest component up: the largest decides the sign, the rest refine the value.
    double value() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < size_; ++i) sum += components_[i];
        return sum;
    }

private:
    // 3 components of d, 2 products each, of two differences of two parts: 3 * 2 * 4 products of three numbers, each of
    // which adds four components.
    std::array<double, 3 * 2 * 4 * 4> components_;
    std::size_t size_ = 0;
};

struct Difference {
    double parts[2];
};

Difference difference(double a, double b, int scale_exponent) {
    const Pair sum = two_sum(a, -b);
    return {{std::ldexp(sum.high, -scale_exponent), std::ldexp(sum.low, -scale_exponent)}};
}

// expansion += factor * a * b
void add_triple(Expansion& expansion, double factor, const Difference& a, const Difference& b) {
    for (double x : a.parts) {
        if (x == 0.0) continue;
        for (double y : b.parts) {
            if (y == 0.0) continue;
            const Pair product = two_product(x, y);
            expansion.add_product(factor, product.low);
            expansion.add_product(factor, product.high);
        }
    }
}

// d with its axes scaled, and then all of it, so that its largest component is around 1.
Vec3 scale_direction(const Vec3& d, const AxisScale& scale) {
    int exponents[3];
    int largest = std::numeric_limits<int>::min();
    for (int axis = 0; axis < 3; ++axis) {
        if (d[axis] == 0.0) continue;
        exponents[axis] = std::ilogb(d[axis]) - scale.exponents[axis];
        largest = std::max(largest, exponents[axis]);
    }
    Vec3 scaled(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        if (d[axis] != 0.0) scaled[axis] = std::ldexp(d[axis], -scale.exponents[axis] - largest);
    }
    return scaled;
}

} // namespace

AxisScale AxisScale::of(const Vec3& largest) {
    AxisScale scale{};
    for (int axis = 0; axis < 3; ++axis) scale.exponents[axis] = largest[axis] > 0.0 ? std::ilogb(largest[axis]) : 0;
    return scale;
}

double exact_determinant(const Vec3& unscaled_d, const Vec3& o, const Vec3& p, const Vec3& q, const AxisScale& scale) {
    const Vec3 d = scale_direction(unscaled_d, scale);
    Difference dp[3];
    Difference dq[3];
    for (int axis = 0; axis < 3; ++axis) {
        dp[axis] = difference(p[axis], o[axis], scale.exponents[axis]);
        dq[axis] = difference(q[axis], o[axis], scale.exponents[axis]);
    }
    Expansion expansion;
    for (int axis = 0; axis < 3; ++axis) {
        if (d[axis] == 0.0) continue;
        const int next = (axis + 1) % 3;
        const int last = (axis + 2) % 3;
        add_triple(expansion, d[axis], dp[next], dq[last]);
        add_triple(expansion, -d[axis], dp[last], dq[next]);
    }
    return expansion.value();
}

} // namespace raywise
