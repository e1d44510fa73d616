#include "geometry/crossings.h"

#include "geometry/exact_integers.h"

#include <algorithm>

namespace raywise {
namespace {

// Whether the point hit may lie on an edge; most do not, and are done with.
bool may_be_on_edge(const PrimitiveHit& hit) {
    return hit.u == 0.0 || hit.v == 0.0 || hit.u + hit.v > 1.0 - 0x1p-24; // u and v are good to 2^-30
}

// A ray that is moved aside, towards the inside of a triangle.
class NudgedRay {
public:
    NudgedRay(const ExactRay& ray, const Corners& towards)
        : ray_(ray), towards_(towards), direction_(BinaryUnit{ray.direction}.count(ray.direction)) {}

    // For a triangle that the ray meets.
    bool meets(const Corners& triangle) const {
        const BinaryUnit length{ray_.origin, towards_[0], towards_[1], towards_[2],
                                triangle[0], triangle[1], triangle[2]};
        const WideVec3 origin = length.count(ray_.origin);
        WideVec3 step{}; // from the point hit to the inside; what lies along the direction cancels below
        for (const Vec3& corner : towards_) step = step + (length.count(corner) - origin);
        WideVec3 p[3];
        for (int i = 0; i < 3; ++i) p[i] = length.count(triangle[i]) - origin;

        int side = 0;
        for (int i = 0; i < 3; ++i) {
            const int sign = side_of_edge(p[i], p[(i + 1) % 3], step);
            if (side * sign < 0) return false;
            side = sign;
        }
        return true;
    }

private:
    // On which side of the ray an edge passes; never 0 but for an edge along the ray, which no triangle that is met has.
    int side_of_edge(const WideVec3& p, const WideVec3& q, const WideVec3& step) const {
        const int sign = dot(direction_, cross(p, q)).sign();
        if (sign != 0) return sign;
        // How the determinant changes when the origin moves.
        const WideVec3 change = cross(p - q, direction_);
        for (const int next : {dot(step, change).sign(), change.x.sign(), change.y.sign(), change.z.sign()}) {
            if (next != 0) return next;
        }
        return 0;
    }

    const ExactRay& ray_;
    const Corners& towards_;
    WideVec3 direction_;
};

} // namespace

void keep_crossings(const ExactRay& ray, const Primitives& primitives, std::vector<PrimitiveHit>& hits,
                    std::size_t first) {
    if (hits.size() - first < 2) return;
    // The first hit stays; where no other may be on an edge there is nothing to decide.
    const auto others = hits.begin() + static_cast<std::ptrdiff_t>(first) + 1;
    if (std::none_of(others, hits.end(), may_be_on_edge)) return;
    const Corners towards = primitives.corners(hits[first].primitive);
    const NudgedRay nudged(ray, towards);
    hits.erase(std::remove_if(others, hits.end(),
                              [&](const PrimitiveHit& hit) {
                                  return may_be_on_edge(hit) && !nudged.meets(primitives.corners(hit.primitive));
                              }),
               hits.end());
}

} // namespace raywise
