// How a ray walks through a binary bounding volume hierarchy (Rubin and Whitted 1980; Goldsmith and Salmon 1987).
#pragma once

#include "accel/bvh/binary_tree.h"
#include "ray/cell_ray.h"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace raywise {

// A ray made ready for the boxes of one tree: a slab test (Kay and Kajiya 1986) in the tree's coordinates.
//
// No box that holds a hit is skipped. A hit is a point of the ray's line inside the triangle, at some s*. The box holds the triangle, so on
// each axis s* lies between the exact distances of the two planes. What is computed for a plane differs from its distance because the
// difference and the product round, which is within the ray's margin (ray/cell_ray.h), and because the start is rounded where the tree has
// a center or the ray was moved: by less than 2^-51 of its coordinates there. On an axis where the direction is nearly zero that moves the
// plane's distance without bound. So the box is widened, by moving the entry planes and the exit planes apart by as much. It costs nothing:
// each set has its own copy of the start.
class BoxRay {
public:
    BoxRay(const CellRay& ray, const Vec3& center) : ray_(ray) {
        const double slack = 0x1p-50 * larger(max_component(magnitudes(ray.start)), max_component(magnitudes(center)));
        for (int axis = 0; axis < 3; ++axis) {
            const bool backwards = std::signbit(ray.inverse[axis]);
            const double start = ray.start[axis] - center[axis];
            backwards_[axis] = backwards ? 1 : 0;
            entry_start_[axis] = backwards ? start - slack : start + slack;
            exit_start_[axis] = backwards ? start + slack : start - slack;
        }
    }

    // Whether the node may hold a hit up to `last`; `near` receives the distance at which the ray enters it. A NaN
    // (zero times infinity: the ray runs along the widened plane) leaves the interval as it is.
    bool may_hit(const BvhNode& node, double last, double& near) const {
        double entry = ray_.first;
        double exit = last;
        for (int axis = 0; axis < 3; ++axis) {
            const double near_plane = node.planes[backwards_[axis]][axis];
            const double far_plane = node.planes[1 - backwards_[axis]][axis];
            const double a = (near_plane - entry_start_[axis]) * ray_.inverse[axis];
            const double b = (far_plane - exit_start_[axis]) * ray_.inverse[axis];
            entry = a > entry ? a : entry;
            exit = b < exit ? b : exit;
        }
        near = entry - ray_.margin(entry);
        return near <= exit + ray_.margin(exit);
    }

private:
    const CellRay& ray_;
    Vec3 entry_start_;
    Vec3 exit_start_;
    int backwards_[3]; // 1 where the ray enters through the upper plane
};

// Walks through the tree: of two children that may hold hits the one entered first is looked at first. visit(leaf, last) tests the
// references of a leaf, lowers `last`, the s behind which no hit is of use, and returns whether no more are wanted.
template <class Visit>
void traverse_boxes(const BvhTree& tree, const CellRay& ray, const Visit& visit) {
    if (tree.empty()) return;
    const BoxRay box_ray(ray, tree.frame.center());

    struct Entry {
        double near;
        const BvhNode* node;
    };
    Entry stack[bvh_max_depth]; // at most one per level
    int height = 0;

    double last = ray.last;
    double near;
    const BvhNode* node = &tree.root;
    if (!box_ray.may_hit(*node, last, near)) return;
    for (;;) {
        if (node->is_leaf()) {
            if (visit(*node, last)) return;
        } else {
            const BvhPair& pair = tree.pairs[node->first];
            double near0;
            double near1;
            const bool hit0 = box_ray.may_hit(pair.child[0], last, near0);
            const bool hit1 = box_ray.may_hit(pair.child[1], last, near1);
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
        } while (stack[height].near > last);
        node = stack[height].node;
    }
}

} // namespace raywise
