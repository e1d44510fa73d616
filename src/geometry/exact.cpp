#include "geometry/exact.h"

#include "geometry/exact_integers.h"

#include <algorithm>
#include <cmath>

namespace raywise {

bool exact_weights(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c,
                   Weights& weights) {
    const BinaryUnit length{origin, a, b, c};
    const WideVec3 o = length.count(origin);
    const WideVec3 d = BinaryUnit{direction}.count(direction);
    const WideVec3 pa = length.count(a) - o;
    const WideVec3 pb = length.count(b) - o;
    const WideVec3 pc = length.count(c) - o;

    const WideVec3 moment_b = cross(d, pb);
    const WideInteger wa = dot(moment_b, pc);
    const WideInteger wc = -dot(moment_b, pa);
    if (wa.sign() * wc.sign() < 0) return false;
    const WideInteger wb = dot(cross(d, pc), pa);
    if (wa.sign() * wb.sign() < 0 || wb.sign() * wc.sign() < 0) return false;
    if (wa.is_zero() && wb.is_zero() && wc.is_zero()) return false; // no area, or seen edge-on

    const int shift = std::max(bit_length(wa), std::max(bit_length(wb), bit_length(wc)));
    weights = {scaled_down(wa, shift), scaled_down(wb, shift), scaled_down(wc, shift)};
    return true;
}

Vec3 exact_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    const BinaryUnit length{a, b, c};
    const WideVec3 first = length.count(a);
    const WideVec3 normal = cross(length.count(b) - first, length.count(c) - first);
    const int shift = std::max(bit_length(normal.x), std::max(bit_length(normal.y), bit_length(normal.z)));
    return {scaled_down(normal.x, shift), scaled_down(normal.y, shift), scaled_down(normal.z, shift)};
}

} // namespace raywise
