#include "accel/projected/projected_bvh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace raywise {
namespace {

constexpr std::uint32_t root_box = 0xFFFFFFFFu;

// Projects the 3D tree onto one plane.
class PlaneTreeBuilder {
public:
    PlaneTreeBuilder(const BuildInput& input, const BvhTree& boxes, const ProjectionPlane& plane, bool keep_boxes)
        : input_(input), boxes_(boxes), plane_(plane), keep_boxes_(keep_boxes) {}

    PlaneTree build() {
        project();
        if (root_.empty()) return {};
        choose_center();
        PlaneTree tree = std::move(tree_);
        tree.empty = false;
        emit(tree);
        return tree;
    }

private:
    const BvhNode& box(std::uint32_t node) const {
        return node == root_box ? boxes_.root : boxes_.pairs[node / 2].child[node % 2];
    }
    const Footprint& footprint(std::uint32_t node) const { return node == root_box ? root_ : footprints_[node]; }

    // The leaves from their triangles, all others as unions of their children (thesis, Figure 3.8: tighter than the
    // projection of the parent's box).
    void project() {
        const std::uint64_t count = 2 * boxes_.pairs.size();
        footprints_.resize(count);
        input_.parallel.for_blocks(count, 4096, [&](std::uint64_t begin, std::uint64_t end) {
            for (std::uint64_t i = begin; i < end; ++i) {
                const BvhNode& node = box(static_cast<std::uint32_t>(i));
                if (node.is_leaf()) footprints_[i] = leaf_footprint(node);
            }
        });
        // Children have higher numbers.
        for (std::uint64_t i = count; i-- > 0;) {
            const BvhNode& node = box(static_cast<std::uint32_t>(i));
            if (!node.is_leaf()) footprints_[i] = children_footprint(node);
        }
        root_ = boxes_.root.is_leaf() ? leaf_footprint(boxes_.root) : children_footprint(boxes_.root);
    }

    Footprint leaf_footprint(const BvhNode& node) const {
        Footprint footprint;
        for (std::uint32_t i = 0; i < node.count; ++i) {
            footprint.extend(plane_.footprint(input_.primitives.corners(boxes_.references[node.first + i])));
        }
        return footprint;
    }
    Footprint children_footprint(const BvhNode& node) const {
        Footprint footprint = footprints_[2 * node.first];
        footprint.extend(footprints_[2 * node.first + 1]);
        return footprint;
    }

    void choose_center() {
        for (int i = 0; i < 2; ++i) {
            const double middle = 0.5 * root_.lower[i] + 0.5 * root_.upper[i];
            tree_.center[i] = std::isfinite(middle) ? middle : 0.0;
        }
        tree_.depth_center = 0.5 * root_.near + 0.5 * root_.far;
        tree_.widest_ray = 0.0625 * std::max(root_.upper.x - root_.lower.x, root_.upper.y - root_.lower.y);
    }

    // The next node on the way down that has triangles on the plane in it: itself, when it is a leaf or both its
    // children have.
    std::uint32_t skip_single(std::uint32_t node) const {
        for (;;) {
            const BvhNode& n = box(node);
            if (n.is_leaf()) return node;
            const std::uint32_t left = 2 * n.first;
            const std::uint32_t right = left + 1;
            if (!footprints_[left].empty() && !footprints_[right].empty()) return node;
            node = footprints_[left].empty() ? right : left;
        }
    }

    // A pair for each node with two children, depth first.
    void emit(PlaneTree& tree) const {
        struct Open {
            std::uint32_t node;
            std::uint32_t pair; // where it goes
            int child;          // no_child: the root
        };
        constexpr int no_child = -1;
        std::vector<Open> open{{skip_single(root_box), 0, no_child}};
        while (!open.empty()) {
            const Open o = open.back();
            open.pop_back();
            const BvhNode& source = box(o.node);
            PlaneNode node = make_node(tree, footprint(o.node));
            node.first = source.first;
            node.count = source.count;
            if (!source.is_leaf()) {
                node.first = static_cast<std::uint32_t>(tree.pairs.size());
                tree.pairs.emplace_back();
                std::uint32_t nearer = skip_single(2 * source.first);
                std::uint32_t farther = skip_single(2 * source.first + 1);
                if (footprint(farther).near < footprint(nearer).near) std::swap(nearer, farther);
                if (keep_boxes_) {
                    tree.boxes.push_back(nearer);
                    tree.boxes.push_back(farther);
                }
                open.push_back({farther, node.first, 1});
                open.push_back({nearer, node.first, 0});
            }
            (o.child == no_child ? tree.root : tree.pairs[o.pair].child[o.child]) = node;
        }
        tree.pairs.shrink_to_fit();
        tree.boxes.shrink_to_fit();
    }

    static PlaneNode make_node(const PlaneTree& tree, const Footprint& footprint) {
        PlaneNode node{};
        for (int i = 0; i < 2; ++i) {
            node.sides[i] = float_below(footprint.lower[i] - tree.center[i]);
            node.sides[2 + i] = -float_above(footprint.upper[i] - tree.center[i]);
        }
        node.near = float_below(footprint.near - tree.depth_center);
        node.far = float_above(footprint.far - tree.depth_center);
        return node;
    }

    const BuildInput& input_;
    const BvhTree& boxes_;
    const ProjectionPlane& plane_;
    const bool keep_boxes_;
    PageVector<Footprint> footprints_; // of all nodes but the root
    Footprint root_;
    PlaneTree tree_;
};

} // namespace

PlaneRay::PlaneRay(const ExactRay& ray, const ProjectedRay& projected, const PlaneTree& tree, double largest_extent)
    : cut_(float_above(projected.cut - tree.depth_center)),
      depth_(projected.depth - tree.depth_center),
      rate_(projected.depth_rate),
      depth_error_(projected.depth_error),
      largest_extent_(largest_extent),
      scale_(ray.scale) {
    for (int i = 0; i < 2; ++i) {
        sides_[i] = float_above(projected.upper[i] - tree.center[i]);
        sides_[2 + i] = -float_below(projected.lower[i] - tree.center[i]);
    }
    // The depth of where the ray starts, which stays, and of the limit, which moves.
    const double start = depth_ + (ray.scaled_tmin - hit_error(ray.scaled_tmin, largest_extent)) * rate_;
    near_ = float_below(start - depth_error_);
    far_ = float_above(start + depth_error_);
    set_limit(ray.tmax);
}

ProjectedBvh::ProjectedBvh(const BuildInput& input, ProjectionScheme scheme)
    : TraversedAccel(input.primitives), tree_(build_bvh(input, input.view ? 0.7 : 1.0)), scheme_(scheme) {
    if (!input.view || tree_.empty() || scheme_ == ProjectionScheme::boxes) return;
    view_ = ViewPlanes(*input.view, scene_extent(input.primitives));
    const std::size_t count = view_.planes().size();
    for (std::size_t i = 0; i < count; ++i) {
        input.progress.report(0.7 + 0.3 * static_cast<double>(i) / static_cast<double>(count), "projection");
        const bool keep_boxes = scheme_ == ProjectionScheme::combined;
        trees_.push_back(PlaneTreeBuilder(input, tree_, view_.planes()[i], keep_boxes).build());
    }
}

std::size_t ProjectedBvh::bytes() const {
    std::size_t bytes = sizeof *this + tree_.bytes() + trees_.capacity() * sizeof(PlaneTree);
    for (const PlaneTree& tree : trees_) bytes += tree.bytes();
    return bytes;
}

const PlaneTree* ProjectedBvh::find_plane(const ExactRay& ray, PlaneRay& plane_ray) const {
    if (trees_.empty()) return nullptr;
    const auto plane = static_cast<std::size_t>(view_.choose(ray));
    ProjectedRay projected;
    if (!view_.planes()[plane].project(ray, projected)) return nullptr;
    const PlaneTree& tree = trees_[plane];
    if (tree.empty) return &tree;
    const Vec2 size = projected.upper - projected.lower;
    if (!(std::max(size.x, size.y) <= tree.widest_ray)) return nullptr;
    plane_ray = PlaneRay(ray, projected, tree, primitives().largest_extent());
    return &tree;
}

} // namespace raywise
