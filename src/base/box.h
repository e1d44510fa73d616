// Axis-aligned boxes: Box in double precision for builders, BoxF in float32, rounded outwards, for nodes.
#pragma once

#include "base/vec.h"

#include <cmath>
#include <limits>

namespace raywise {

struct Box {
    Vec3 lower{std::numeric_limits<double>::infinity()};
    Vec3 upper{-std::numeric_limits<double>::infinity()};

    bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
    Vec3 size() const { return upper - lower; }
    Vec3 center() const { return 0.5 * lower + 0.5 * upper; }

    void extend(const Vec3& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    void extend(const Box& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }

    // Half the surface area: what the surface area heuristic needs; 0 for an empty box.
    double half_area() const {
        if (empty()) return 0.0;
        const Vec3 s = size();
        return s.x * s.y + s.y * s.z + s.z * s.x;
    }

    int longest_axis() const {
        const Vec3 s = size();
        return s.x >= s.y ? (s.x >= s.z ? 0 : 2) : (s.y >= s.z ? 1 : 2);
    }
};

inline Box merge(Box a, const Box& b) {
    a.extend(b);
    return a;
}

// The largest float not above x, and the smallest not below it. |x| has to be at most FLT_MAX.
inline float round_down(double x) {
    const float f = static_cast<float>(x);
    return static_cast<double>(f) <= x ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}
inline float round_up(double x) {
    const float f = static_cast<float>(x);
    return static_cast<double>(f) >= x ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
}

struct BoxF {
    Vec3f lower{std::numeric_limits<float>::infinity()};
    Vec3f upper{-std::numeric_limits<float>::infinity()};
};

inline BoxF round_outwards(const Box& box) {
    if (box.empty()) return {};
    return {{round_down(box.lower.x), round_down(box.lower.y), round_down(box.lower.z)},
            {round_up(box.upper.x), round_up(box.upper.y), round_up(box.upper.z)}};
}

} // namespace raywise
