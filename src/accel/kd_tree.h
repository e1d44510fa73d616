// The kd-tree: planes that part space in two, over and over, with the primitives of each part in the leaves (Bentley
// 1975; KdTreeAccel in Chuang's lecture "Acceleration"). How it is built: kd_tree_build.h.
//
// Why the walk cannot lose a hit. Let P be the point where the exact ray meets a primitive, at the exact distance t.
// The builder sees to it that, from the root down, the primitive is always on a side of the plane that P belongs to;
// points on the plane belong to both. That leads to one leaf. The walk reaches it, because at every node on the way t
// lies within its interval [near, far] but for margin / 8:
// - near and far each come from one distance, (plane - origin) * inverse with one rounding each, to a plane of a node
//   or a face of the bounds (or from tmin and tmax, or the best hit so far, which are accurate to margin / 8 too).
//   Its relative error is below 4 * 2^-53, and as P is within the bounds, |t| is at most the ray's distance from the
//   bounds, R: up to 2 R the error is nothing against the margin, 2^-34 * R, and beyond 2 R it cannot move a plane
//   across t.
// - A child is left out only when its plane is beyond the interval's end by the whole margin.
// Along an axis without movement the distance is infinite, on the right side by its sign, or not a number when the
// origin lies in the plane, and then no comparison holds and both children are visited.
#pragma once

#include "accel/kd_tree_build.h"
#include "accel/visitors.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace raywise {

class KdTree final : public TraversedAccel<KdTree> {
public:
    explicit KdTree(const BuildInput& input);

    std::size_t bytes() const override;

    const KdTreeData& data() const { return tree_; }

    template <class Visitor>
    void traverse(const PreparedRay& ray, Visitor& visitor) const;

private:
    template <class Visitor>
    void traverse_all(Visitor& visitor) const {
        for (std::uint32_t i = 0; i < primitives().count(); ++i) {
            if (visitor.visit(i)) return;
        }
    }

    KdTreeData tree_;
};

template <class Visitor>
void KdTree::traverse(const PreparedRay& ray, Visitor& visitor) const {
    if (tree_.nodes.empty()) {
        if (tree_.too_large) traverse_all(visitor);
        return;
    }
    std::array<std::uint32_t, 3> nearer; // which child the ray meets first
    for (int axis = 0; axis < 3; ++axis) {
        nearer[static_cast<std::size_t>(axis)] = std::signbit(ray.inverse[axis]) ? 1u : 0u;
        // A component below 2^-1024 has no inverse, so its distances are not accurate: such rays test all primitives.
        if (std::isinf(ray.inverse[axis]) && ray.direction[axis] != 0.0) return traverse_all(visitor);
    }

    struct Part {
        std::uint32_t node;
        double near;
        double far;
    };
    std::array<Part, most_kd_levels> stack;
    std::size_t waiting = 0;

    const double margin = ray.margin;
    const Interval whole = box_interval(ray, primitives().bounds());
    double near = std::max(whole.near, ray.tmin);
    double far = std::min(whole.far, visitor.limit());
    if (!(near <= far + margin)) return;
    const KdNode* nodes = tree_.nodes.data();
    std::uint32_t at = 0;
    for (;;) {
        KdNode node = nodes[at];
        while (!node.is_leaf()) {
            const int axis = node.axis();
            const double t =
                (KdTreeData::plane(tree_.plane_base[axis], node.split()) - ray.origin[axis]) * ray.inverse[axis];
            const std::uint32_t first = nearer[static_cast<std::size_t>(axis)];
            if (t > far + margin) {
                at = node.child() + first;
            } else if (t < near - margin) {
                at = node.child() + (first ^ 1u);
            } else {
                stack[waiting++] = {node.child() + (first ^ 1u), t > near ? t : near, far};
                at = node.child() + first;
                far = t < far ? t : far;
            }
            node = nodes[at];
        }
        if (node.count() == 1) {
            if (visitor.visit(node.first())) return;
        } else {
            const std::uint32_t* reference = tree_.references.data() + node.first();
            for (std::uint32_t i = 0; i < node.count(); ++i) {
                if (visitor.visit(reference[i])) return;
            }
        }
        const double limit = visitor.limit();
        do {
            if (waiting == 0) return;
            --waiting;
        } while (stack[waiting].near > limit + margin);
        at = stack[waiting].node;
        near = stack[waiting].near;
        far = std::min(stack[waiting].far, limit);
    }
}

} // namespace raywise
