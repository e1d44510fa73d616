// Most arrays lie apart, which the ends of their ranges tell. Where ranges meet, numbers i of the one and j of the other are
// distance + j * other.stride - i * one.stride bytes apart, for each pair of components, and share a byte when that is less than
// a number's size: a linear equation in i and j for each of those few distances, solved with the greatest common divisor of the
// strides.
#include "base/shared_bytes.h"

#include <algorithm>
#include <cstdlib>

namespace raywise {
namespace {

// Holds what 64 bits and 64 bits multiply to.
__extension__ using Wide = __int128;

struct Range {
    Wide begin, end;
};

// More elements than can be in memory, and few enough for their distances not to overflow.
constexpr std::uint64_t most_elements = std::uint64_t{1} << 60;

Wide last_index(const ByteLayout& a) { return static_cast<Wide>(std::min(a.count, most_elements)) - 1; }

// The bytes from the lowest to the highest.
Range range_of(const ByteLayout& a) {
    const Wide elements = last_index(a) * a.stride;
    const Wide components = static_cast<Wide>(a.components - 1) * a.component_stride;
    const Wide begin = static_cast<Wide>(a.address) + std::min<Wide>(elements, 0) + std::min<Wide>(components, 0);
    const Wide end = static_cast<Wide>(a.address) + std::max<Wide>(elements, 0) + std::max<Wide>(components, 0);
    return {begin, end + static_cast<Wide>(a.size)};
}

Wide floor_quotient(Wide a, Wide b) {
    const Wide q = a / b;
    return a % b != 0 && (a < 0) != (b < 0) ? q - 1 : q;
}
Wide ceiling_quotient(Wide a, Wide b) { return -floor_quotient(-a, b); }

// g = gcd(a, b) = x * a + ... for a, b > 0.
struct Divisor {
    Wide g, x;
};
Divisor greatest_common_divisor(Wide a, Wide b) {
    Wide x = 1, next_x = 0;
    while (b != 0) {
        const Wide q = a / b;
        const Wide r = a - q * b, next = x - q * next_x;
        a = b;
        b = r;
        x = next_x;
        next_x = next;
    }
    return {a, x};
}

// Whether a * i + b * j = sum for some i in [0, last_i], j in [0, last_j]; a > 0, b > 0.
bool has_solution(Wide a, Wide last_i, Wide b, Wide last_j, Wide sum) {
    const Divisor divisor = greatest_common_divisor(a, b);
    if (sum % divisor.g != 0) return false;
    const Wide step_i = b / divisor.g, step_j = a / divisor.g;
    // The smallest i of all solutions that is not negative; the others are step_i apart, and their j step_j, downwards.
    Wide first_i = (sum / divisor.g % step_i) * (divisor.x % step_i) % step_i;
    if (first_i < 0) first_i += step_i;
    const Wide first_j = (sum - a * first_i) / b;
    const Wide least = std::max<Wide>(0, ceiling_quotient(first_j - last_j, step_j));
    const Wide most = std::min(floor_quotient(last_i - first_i, step_i), floor_quotient(first_j, step_j));
    return least <= most;
}

// Whether distance + other.stride * j - one.stride * i is between -other.size and one.size, both excluded.
bool are_near(const ByteLayout& one, const ByteLayout& other, Wide distance) {
    const Wide below = -static_cast<Wide>(other.size) + 1, above = static_cast<Wide>(one.size) - 1;
    Wide a = one.stride, last_i = last_index(one), b = other.stride, last_j = last_index(other);
    if (last_i == 0) a = 0;
    if (last_j == 0) b = 0;
    if (a == b) { // the usual case of arrays in one struct: only i - j counts
        if (a == 0) return distance >= below && distance <= above;
        if (a < 0) { // from the far end, i - j becomes j - i
            std::swap(last_i, last_j);
            a = -a;
        }
        const Wide least = std::max(-last_j, ceiling_quotient(distance - above, a));
        return least <= std::min(last_i, floor_quotient(distance - below, a));
    }
    // Turned round so that both strides are positive: a * i + b * j = distance - apart.
    if (a < 0) {
        distance -= a * last_i;
        a = -a;
    }
    b = -b;
    if (b < 0) {
        distance -= b * last_j;
        b = -b;
    }
    for (Wide apart = below; apart <= above; ++apart) {
        const Wide sum = distance - apart;
        if (a == 0 || b == 0) {
            const Wide stride = a + b, last = a == 0 ? last_j : last_i;
            if (sum >= 0 && sum % stride == 0 && sum / stride <= last) return true;
        } else if (has_solution(a, last_i, b, last_j, sum)) {
            return true;
        }
    }
    return false;
}

} // namespace

bool share_bytes(const ByteLayout& one, const ByteLayout& other) {
    if (one.is_empty() || other.is_empty()) return false;
    const Range mine = range_of(one), theirs = range_of(other);
    if (mine.end <= theirs.begin || theirs.end <= mine.begin) return false;
    for (int c = 0; c < one.components; ++c) {
        for (int d = 0; d < other.components; ++d) {
            const Wide distance = static_cast<Wide>(other.address) - static_cast<Wide>(one.address) +
                                  static_cast<Wide>(d) * other.component_stride -
                                  static_cast<Wide>(c) * one.component_stride;
            if (are_near(one, other, distance)) return true;
        }
    }
    return false;
}

} // namespace raywise
