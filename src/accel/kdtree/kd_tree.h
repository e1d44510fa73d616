// The kd-tree: planes that part space in two, over and over, with the primitives of each part in the leaves (Bentley
// 1975; KdTreeAccel in Chuang's lecture "Acceleration"). How it is built: kd_tree_build.h.
//
// Why the walk cannot lose a hit. Let P be the point where the exact ray meets a primitive, at the exact distance t.
// The builder sees to it that, from the root down, the primitive is always on a side of the plane that P belongs to;
// points on the plane belong to both. That leads to one leaf. The walk reaches it, because at every node on the way t
// lies within its interval [near, far], which is wider by the ray's margin (ray/cell_ray.h) on both sides: each end comes from one
// distance, (plane - start) * inverse, to a plane of a node or a face of the bounds, or from tmin, tmax, or the best hit so far, and is
// moved outwards by the margin there.
// Along an axis without movement the distance is infinite, on the right side by its sign, or not a number when the
// start lies in the plane, and then no comparison holds and both children are visited.
#pragma once

#include "accel/kdtree/kd_tree_build.h"
#include "accel/traversed_accel.h"
#include "ray/cell_ray.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace raywise {

class KdTree final : public TraversedAccel<KdTree> {
public:
    explicit KdTree(const BuildInput& input);

    std::size_t bytes() const override;

    const KdTreeData& data() const { return tree_; }

    template <class Collector>
    void traverse(const ExactRay& ray, Collector& collector) const;

private:
    // is_moved: whether the planes' distances have an error besides the margin. Nearly no ray is, and the others need not wait for two sums
    // at each node (a twentieth of their time).
    template <bool is_moved, class Collector>
    void walk(const CellRay& ray, const ExactRay& exact_ray, Collector& collector) const;

    KdTreeData tree_;
};

template <class Collector>
void KdTree::traverse(const ExactRay& exact_ray, Collector& collector) const {
    if (tree_.nodes.empty()) {
        if (tree_.too_large) test_all_primitives(exact_ray, collector);
        return;
    }
    const CellRay ray(exact_ray, primitives().bounds(), primitives().largest_extent());
    if (!ray.is_known()) return test_all_primitives(exact_ray, collector);
    if (ray.is_moved()) return walk<true>(ray, exact_ray, collector);
    walk<false>(ray, exact_ray, collector);
}

template <bool is_moved, class Collector>
void KdTree::walk(const CellRay& ray, const ExactRay& exact_ray, Collector& collector) const {
    double near = ray.first;
    double far = ray.last;
    // What a node asks of its axis, side by side: the axes of the nodes on a way are hard to predict, so that a choice by branches
    // would cost more than the step.
    struct Axis {
        double plane_base;
        double start;
        double inverse;
        double plane_error;
        std::uint32_t nearer; // which child the ray meets first
    };
    std::array<Axis, 3> axes;
    for (int axis = 0; axis < 3; ++axis) {
        axes[static_cast<std::size_t>(axis)] = {tree_.plane_base[axis], ray.start[axis], ray.inverse[axis],
                                                ray.plane_error[axis], std::signbit(ray.inverse[axis]) ? 1u : 0u};
        const double lower = primitives().bounds().lower[axis];
        const double upper = primitives().bounds().upper[axis];
        if (ray.direction[axis] == 0.0) {
            if (ray.start[axis] < lower || ray.start[axis] > upper) return;
            continue;
        }
        const Interval slab = ray.slab(axis, lower, upper);
        near = larger(near, slab.near);
        far = smaller(far, slab.far);
    }
    if (!(near <= far)) return;

    struct Part {
        std::uint32_t node;
        double near;
        double far;
    };
    std::array<Part, most_kd_levels> stack;
    std::size_t waiting = 0;

    const KdNode* nodes = tree_.nodes.data();
    std::uint32_t at = 0;
    double limit = collector.limit();
    double limit_end = ray.last;
    for (;;) {
        KdNode node = nodes[at];
        while (!node.is_leaf()) {
            const Axis& axis = axes[static_cast<std::size_t>(node.axis())];
            const double t = (KdTreeData::plane(axis.plane_base, node.split()) - axis.start) * axis.inverse;
            const double error = is_moved ? axis.plane_error : 0.0;
            const std::uint32_t first = axis.nearer;
            if (t - error > far) {
                at = node.child() + first;
            } else if (t + error < near) {
                at = node.child() + (first ^ 1u);
            } else {
                const double slack = ray.margin(t) + error;
                stack[waiting++] = {node.child() + (first ^ 1u), t - slack > near ? t - slack : near, far};
                at = node.child() + first;
                far = t + slack < far ? t + slack : far;
            }
            node = nodes[at];
        }
        const std::uint32_t single = node.first();
        const std::uint32_t* const list = node.count() == 1 ? &single : tree_.references.data() + node.first();
        if (test_primitives(primitives(), exact_ray, list, node.count(), collector)) return;
        if (collector.limit() < limit) {
            limit = collector.limit();
            limit_end = ray.upper_end(limit);
        }
        do {
            if (waiting == 0) return;
            --waiting;
        } while (stack[waiting].near > limit_end);
        at = stack[waiting].node;
        near = stack[waiting].near;
        far = smaller(stack[waiting].far, limit_end);
    }
}

} // namespace raywise
