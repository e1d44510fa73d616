// How nodes and leaves of a WideBvh are written, by whoever makes one.
#pragma once

#include "accel/bvh/node.h"
#include "base/box.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace raywise {

inline void set_empty(WideNode& node, std::uint32_t i) {
    for (auto& planes : node.planes) {
        planes[0][i] = empty_plane;
        planes[1][i] = -empty_plane;
    }
}

// The box of a leaf. lower, upper: in the coordinates of the frame. extent: of its triangles, of which it may hold but parts. See
// ray/traversal_ray.h for how much wider the box is made.
inline void set_leaf_box(WideNode& node, std::uint32_t i, const Vec3& lower, const Vec3& upper, double extent) {
    const double slack = 0x1p-26 * extent + 0x1p-112;
    for (int axis = 0; axis < 3; ++axis) {
        node.planes[axis][0][i] = round_down(lower[axis] - slack);
        node.planes[axis][1][i] = round_up(upper[axis] + slack);
    }
}

// The box around all children of another node. It is empty when all of those are.
inline void set_box_around(WideNode& node, std::uint32_t i, const WideNode& inner) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto& planes = inner.planes[axis];
        node.planes[axis][0][i] = *std::min_element(planes[0], planes[0] + wide_bvh_width);
        node.planes[axis][1][i] = *std::max_element(planes[1], planes[1] + wide_bvh_width);
    }
}

// Makes room for the blocks of so many triangles, of the type that the meshes ask for.
void make_blocks(WideBvh& bvh, const Primitives& primitives, std::size_t triangles);

// Writes the leaves of a tree that has its frame and its blocks. Each thread needs one of its own.
class LeafWriter {
public:
    LeafWriter(WideBvh& bvh, const Primitives& primitives);

    struct Leaf {
        NodeRef reference;
        Vec3 lower; // of its box, in the coordinates of the frame
        Vec3 upper;

        double extent() const { return max_component(upper - lower); }
    };
    // A leaf of `count` primitives that begins at triangle `first`.
    Leaf write(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count);

private:
    Box write_float32(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count);
    Box write_float64(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count);
    const TriangleMesh& mesh_of(std::uint32_t primitive);

    WideBvh& bvh_;
    const Primitives& primitives_;
    // The mesh looked at last, and the numbers of its triangles: neighbours are of one mesh, mostly.
    const TriangleMesh* mesh_ = nullptr;
    std::uint32_t mesh_first_ = 0;
    std::uint32_t mesh_count_ = 0;
};

} // namespace raywise
