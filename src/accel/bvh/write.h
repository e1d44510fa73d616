// How nodes and leaves of a WideBvh are written, by whoever makes one.
#pragma once

#include "accel/bvh/build/bounds.h"
#include "accel/bvh/node.h"
#include "geometry/mesh_cursor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace raywise {

inline void set_box(WideNode& node, std::uint32_t i, const Bounds& box) {
    for (int axis = 0; axis < 3; ++axis) {
        node.planes[axis][0][i] = box.lower[axis];
        node.planes[axis][1][i] = box.upper[axis];
    }
}

// What no ray meets.
inline Bounds empty_box() { return {fill_lanes(empty_plane), fill_lanes(-empty_plane)}; }

inline void set_empty(WideNode& node, std::uint32_t i) { set_box(node, i, empty_box()); }

// Of all children.
inline void set_boxes(WideNode& node, const Bounds (&boxes)[wide_bvh_width]) {
    for (std::uint32_t i = 0; i < wide_bvh_width; i += 4) {
        for (const int side : {0, 1}) {
            Lanes corners[4];
            for (std::uint32_t k = 0; k < 4; ++k) corners[k] = side == 0 ? boxes[i + k].lower : boxes[i + k].upper;
            Lanes axes[3];
            to_axes(corners, axes);
            for (int axis = 0; axis < 3; ++axis)
                std::memcpy(&node.planes[axis][side][i], &axes[axis], sizeof axes[axis]);
        }
    }
}

// The box of a leaf around its triangles, in the coordinates of the frame. extent: of the triangles, of which the leaf may hold but parts.
// See ray/traversal_ray.h for how much wider the box is made.
RW_INLINE Bounds leaf_box(const Bounds& around, double extent) {
    const double slack = 0x1p-26 * extent + 0x1p-112;
    return {round_down(__builtin_convertvector(around.lower, DoubleLanes) - slack),
            round_up(__builtin_convertvector(around.upper, DoubleLanes) + slack)};
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
        Bounds box;    // as leaf_box() makes it of all of its triangles
        double extent; // of its triangles, along any axis
    };
    // Asks for the corners of primitives that leaves will soon be written of: where those lie far from each other, that is what writing waits
    // for.
    void prefetch(const std::uint32_t* primitives, std::uint32_t count);
    // A leaf of `count` primitives that begins at triangle `first`.
    Leaf write(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count);

private:
    WideBvh& bvh_;
    MeshCursor cursor_;
};

} // namespace raywise
