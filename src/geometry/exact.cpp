#include "geometry/exact.h"

#include "geometry/exact_integers.h"
#include "geometry/expansion.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace raywise {
namespace {

// Whether one is above zero and one below: the line passes beside the triangle. All zero: no area, or seen edge-on.
template <class Sign>
bool are_weights(Sign a, Sign b, Sign c) {
    const bool positive = a > 0 || b > 0 || c > 0;
    const bool negative = a < 0 || b < 0 || c < 0;
    return positive != negative;
}

// ---- Sums of doubles: the faster way, above all where many components or differences are zero or short.

// Numbers between these have products of three, and roundings of those, within the range of doubles.
constexpr double smallest_summed = 0x1p-200;
constexpr double largest_summed = 0x1p200;

bool can_be_summed(std::initializer_list<Vec3> vectors) {
    return std::all_of(vectors.begin(), vectors.end(), [](const Vec3& v) {
        for (int axis = 0; axis < 3; ++axis) {
            const double magnitude = std::fabs(v[axis]);
            if (magnitude != 0.0 && !(magnitude >= smallest_summed && magnitude <= largest_summed)) return false;
        }
        return true;
    });
}

struct Difference {
    Difference(double a, double b) {
        const DoublePair sum = two_sum(a, -b);
        parts[0] = sum.high;
        parts[1] = sum.low;
    }
    double parts[2];
};

struct DifferenceVec3 {
    DifferenceVec3(const Vec3& a, const Vec3& b) : axes{{a.x, b.x}, {a.y, b.y}, {a.z, b.z}} {}
    Difference axes[3];
};

// 3 components of d, 2 products each, of two differences of two parts: 3 * 2 * 4 products of three numbers, each of which adds
// four components.
using Determinant = Expansion<3 * 2 * 4 * 4>;

// determinant += factor * a * b
void add_triple(Determinant& determinant, double factor, const Difference& a, const Difference& b) {
    for (const double x : a.parts) {
        if (x == 0.0) continue;
        for (const double y : b.parts) {
            if (y == 0.0) continue;
            const DoublePair product = two_product(x, y);
            if (product.low != 0.0) determinant.add_product(factor, product.low);
            determinant.add_product(factor, product.high);
        }
    }
}

// d . (p x q)
double summed_determinant(const Vec3& d, const DifferenceVec3& p, const DifferenceVec3& q) {
    Determinant determinant;
    for (int axis = 0; axis < 3; ++axis) {
        if (d[axis] == 0.0) continue;
        const int next = (axis + 1) % 3;
        const int last = (axis + 2) % 3;
        add_triple(determinant, d[axis], p.axes[next], q.axes[last]);
        add_triple(determinant, -d[axis], p.axes[last], q.axes[next]);
    }
    return determinant.value();
}

bool summed_weights(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c,
                    Weights& weights) {
    const DifferenceVec3 pa(a, origin);
    const DifferenceVec3 pb(b, origin);
    const DifferenceVec3 pc(c, origin);
    weights.a = summed_determinant(direction, pb, pc);
    weights.b = summed_determinant(direction, pc, pa);
    if (weights.a * weights.b < 0.0) return false;
    weights.c = summed_determinant(direction, pa, pb);
    return are_weights(weights.a, weights.b, weights.c);
}

// ---- Integers: any numbers.

// The same for several values: what brings the largest below 1.
int common_shift(const WideInteger& a, const WideInteger& b, const WideInteger& c) {
    return std::max(bit_length(a), std::max(bit_length(b), bit_length(c)));
}

bool integer_weights(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c,
                     Weights& weights) {
    const BinaryUnit length{origin, a, b, c};
    const WideVec3 o = length.count(origin);
    const WideVec3 d = BinaryUnit{direction}.count(direction);
    const WideVec3 pa = length.count(a) - o;
    const WideVec3 pb = length.count(b) - o;
    const WideVec3 pc = length.count(c) - o;
    const WideVec3 moment_b = cross(d, pb);
    const WideInteger wa = dot(moment_b, pc);
    const WideInteger wb = dot(cross(d, pc), pa);
    const WideInteger wc = -dot(moment_b, pa);
    const int shift = common_shift(wa, wb, wc);
    weights = {scaled_down(wa, shift), scaled_down(wb, shift), scaled_down(wc, shift)};
    return are_weights(wa.sign(), wb.sign(), wc.sign());
}

} // namespace

bool exact_weights(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c,
                   Weights& weights) {
    return can_be_summed({origin, direction, a, b, c}) ? summed_weights(origin, direction, a, b, c, weights)
                                                       : integer_weights(origin, direction, a, b, c, weights);
}

Vec3 exact_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    const BinaryUnit length{a, b, c};
    const WideVec3 first = length.count(a);
    const WideVec3 normal = cross(length.count(b) - first, length.count(c) - first);
    const int shift = common_shift(normal.x, normal.y, normal.z);
    return {scaled_down(normal.x, shift), scaled_down(normal.y, shift), scaled_down(normal.z, shift)};
}

} // namespace raywise
