// How a ray walks through a binary bounding volume hierarchy (Rubin and Whitted 1980; Goldsmith and Salmon 1987).
#pragma once

#include "accel/bvh_build.h"
#include "base/ray.h"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace raywise {

// A ray made ready for the boxes of one tree: the test of may_hit_box (base/ray.h) in the tree's coordinates.
//
// No box that holds a hit is skipped. A hit is a point of the ray's line inside the triangle, at some t*, and its
// computed t is within margin / 8 of t*. The box holds the triangle, so on each axis t* lies between the exact
// distances of the two planes. What is computed for a plane may differ from its distance for two reasons:
//
// - Rounding of the difference and the product: 2^-51 of the distance. |t*| is at most the ray's reach, and a distance
//   beyond twice the reach stays beyond it, so this is at most 2^-50 of the reach where it matters; the margin is 2^-34
//   of it.
// - The point, the plane or the origin are a little off: the shift to the tree's center rounds box and origin by 2^-52
//   of the reach together, and an inverse that overflows or a difference of denormal numbers is as good as that. On an
//   axis where the direction is nearly zero this moves the plane's distance without bound. So the box is widened, by
//   moving the entry planes and the exit planes apart by 2^-50 of the reach. It costs nothing: each set has its own
//   copy of the origin.
//
// So entry <= t* + margin / 8 <= t + margin / 4 and exit >= t* - margin / 8 >= t - margin / 4 on every axis: all three
// comparisons of may_hit pass with three quarters of the margin to spare.
class BoxRay {
public:
    BoxRay(const PreparedRay& ray, const Vec3& center)
        : inverse_(ray.inverse), tmin_(ray.tmin - ray.margin), margin_(ray.margin) {
        const double slack = 0x1p-16 * ray.margin; // 2^-50 of the reach
        for (int axis = 0; axis < 3; ++axis) {
            const bool backwards = std::signbit(inverse_[axis]);
            const double origin = ray.origin[axis] - center[axis];
            backwards_[axis] = backwards ? 1 : 0;
            entry_origin_[axis] = backwards ? origin - slack : origin + slack;
            exit_origin_[axis] = backwards ? origin + slack : origin - slack;
        }
    }

    // Whether the node may hold a hit up to `limit`; `near` receives the distance at which the ray enters it. A NaN
    // (zero times infinity: the ray runs along the widened plane) leaves the interval as it is.
    bool may_hit(const BvhNode& node, double limit, double& near) const {
        double entry = -std::numeric_limits<double>::infinity();
        double exit = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const double near_plane = node.planes[backwards_[axis]][axis];
            const double far_plane = node.planes[1 - backwards_[axis]][axis];
            const double a = (near_plane - entry_origin_[axis]) * inverse_[axis];
            const double b = (far_plane - exit_origin_[axis]) * inverse_[axis];
            entry = a > entry ? a : entry;
            exit = b < exit ? b : exit;
        }
        near = entry;
        return entry <= exit + margin_ && entry <= limit + margin_ && exit >= tmin_;
    }

    double margin() const { return margin_; }

private:
    Vec3 inverse_;
    Vec3 entry_origin_;
    Vec3 exit_origin_;
    int backwards_[3]; // 1 where the ray enters through the upper plane
    double tmin_;      // less the margin
    double margin_;
};

// Walks through the tree: of two children that may hold hits the one entered first is looked at first.
template <class Visitor>
void traverse_boxes(const BvhTree& tree, const PreparedRay& ray, Visitor& visitor) {
    if (tree.empty()) return;
    const BoxRay box_ray(ray, tree.center);

    struct Entry {
        double near;
        const BvhNode* node;
    };
    Entry stack[bvh_max_depth]; // at most one per level
    int height = 0;

    double near;
    const BvhNode* node = &tree.root;
    if (!box_ray.may_hit(*node, visitor.limit(), near)) return;
    for (;;) {
        if (node->is_leaf()) {
            const std::uint32_t* const references = &tree.references[node->first];
            for (std::uint32_t i = 0; i < node->count; ++i) {
                if (visitor.visit(references[i])) return;
            }
        } else {
            const BvhPair& pair = tree.pairs[node->first];
            const double limit = visitor.limit();
            double near0;
            double near1;
            const bool hit0 = box_ray.may_hit(pair.child[0], limit, near0);
            const bool hit1 = box_ray.may_hit(pair.child[1], limit, near1);
            if (hit0 && hit1) {
                const bool swap = near1 < near0;
                stack[height++] = {swap ? near0 : near1, &pair.child[swap ? 0 : 1]};
                node = &pair.child[swap ? 1 : 0];
                continue;
            }
            if (hit0 || hit1) {
                node = &pair.child[hit0 ? 0 : 1];
                continue;
            }
        }
        // What has been pushed may lie beyond a hit found since.
        do {
            if (height == 0) return;
            --height;
        } while (stack[height].near > visitor.limit() + box_ray.margin());
        node = stack[height].node;
    }
}

} // namespace raywise
