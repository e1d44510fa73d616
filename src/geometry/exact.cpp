#include "geometry/exact.h"

#include "base/expansion.h"
#include "geometry/exact_integers.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace raywise {
namespace {

// Whether one is above zero and one below: the line passes beside the triangle. All zero: no area, or seen edge-on.
template <class Sign>
bool are_weights(Sign a, Sign b, Sign c) {
    const bool positive = a > 0 || b > 0 || c > 0;
    const bool negative = a < 0 || b < 0 || c < 0;
    return positive != negative;
}

int sign_of(double x) { return (x > 0.0 ? 1 : 0) - (x < 0.0 ? 1 : 0); }

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

// 6 products of three differences of two parts, each of which adds eight components.
using Volume = Expansion<6 * 8 * 8>;

// volume += sign * a * b * c
void add_triple(Volume& volume, double sign, const Difference& a, const Difference& b, const Difference& c) {
    for (const double x : a.parts) {
        if (x == 0.0) continue;
        for (const double y : b.parts) {
            if (y == 0.0) continue;
            const DoublePair product = two_product(x, y);
            for (const double z : c.parts) {
                if (z == 0.0) continue;
                if (product.low != 0.0) volume.add_product(sign * z, product.low);
                volume.add_product(sign * z, product.high);
            }
        }
    }
}

// Two products of two differences of two parts, each of which adds two components.
using Area = Expansion<2 * 4 * 2>;

// area += sign * a * b
void add_product(Area& area, double sign, const Difference& a, const Difference& b) {
    for (const double x : a.parts) {
        if (x == 0.0) continue;
        for (const double y : b.parts) {
            if (y != 0.0) area.add_product(sign * x, y);
        }
    }
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

double plane_side(const Vec3& origin, const Vec3& a, const Vec3& b, const Vec3& c) {
    // Each of six products of three rounds by at most 2^-50: three differences, two products and three sums of 2^-53 each.
    const Vec3 pa = a - origin;
    const Vec3 pb = b - origin;
    const Vec3 pc = c - origin;
    const double side = glm::dot(pa, glm::cross(pb, pc));
    const Vec3 products(std::fabs(pb.y * pc.z) + std::fabs(pb.z * pc.y),
                        std::fabs(pb.z * pc.x) + std::fabs(pb.x * pc.z),
                        std::fabs(pb.x * pc.y) + std::fabs(pb.y * pc.x));
    const double sum = glm::dot(glm::abs(pa), products);
    if (sum > 0x1p-900 && std::fabs(side) > 0x1p-49 * sum) return side; // neither holds where something overflowed

    if (can_be_summed({origin, a, b, c})) {
        const DifferenceVec3 p(a, origin);
        const DifferenceVec3 q(b, origin);
        const DifferenceVec3 r(c, origin);
        Volume volume; // p . (q x r), which is the same
        for (int axis = 0; axis < 3; ++axis) {
            const int next = (axis + 1) % 3;
            const int last = (axis + 2) % 3;
            add_triple(volume, 1.0, p.axes[axis], q.axes[next], r.axes[last]);
            add_triple(volume, -1.0, p.axes[axis], q.axes[last], r.axes[next]);
        }
        return volume.value();
    }
    const BinaryUnit length{origin, a, b, c};
    const WideVec3 o = length.count(origin);
    const WideInteger volume = dot(length.count(a) - o, cross(length.count(b) - o, length.count(c) - o));
    if (volume.is_zero()) return 0.0;
    const double magnitude = std::fabs(scaled_down(volume, -3 * length.exponent()));
    return std::copysign(std::max(magnitude, std::numeric_limits<double>::denorm_min()), volume.sign());
}

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 ab = b - a;
    const Vec2 ac = c - a;
    // A difference has the right sign, whatever its rounding; so have products, as long as one tells signs alone.
    const int left = sign_of(ab.x) * sign_of(ac.y);
    const int right = sign_of(ab.y) * sign_of(ac.x);
    if (left != right) return left > right ? 1 : -1;
    if (left == 0) return 0;

    // Each product rounds by at most 3 * 2^-53, and their difference once more.
    const double left_product = ab.x * ac.y;
    const double right_product = ab.y * ac.x;
    const double area = left_product - right_product;
    const double sum = std::fabs(left_product) + std::fabs(right_product);
    if (sum > 0x1p-900 && std::fabs(area) > 0x1p-51 * sum) return sign_of(area); // neither holds after an overflow

    const Vec3 pa(a, 0.0);
    const Vec3 pb(b, 0.0);
    const Vec3 pc(c, 0.0);
    if (can_be_summed({pa, pb, pc})) {
        Area exact_area;
        add_product(exact_area, 1.0, {b.x, a.x}, {c.y, a.y});
        add_product(exact_area, -1.0, {b.y, a.y}, {c.x, a.x});
        return sign_of(exact_area.value());
    }
    const BinaryUnit length{pa, pb, pc};
    const WideVec3 first = length.count(pa);
    const WideVec3 p = length.count(pb) - first;
    const WideVec3 q = length.count(pc) - first;
    return WideInteger(p.x * q.y - p.y * q.x).sign();
}

Vec3 exact_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    const BinaryUnit length{a, b, c};
    const WideVec3 first = length.count(a);
    const WideVec3 normal = cross(length.count(b) - first, length.count(c) - first);
    const int shift = common_shift(normal.x, normal.y, normal.z);
    return {scaled_down(normal.x, shift), scaled_down(normal.y, shift), scaled_down(normal.z, shift)};
}

} // namespace raywise
