// How nodes and leaves of a WideBvh are written, by whoever makes one.
#pragma once

#include "accel/wide_bvh.h"
#include "base/box.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace raywise {

inline void set_absent(WideNode& node, std::uint32_t i) {
    for (auto& planes : node.planes) {
        planes[0][i] = absent_plane;
        planes[1][i] = -absent_plane;
    }
}

// lower, upper: in the coordinates of the frame.
inline void set_box(WideNode& node, std::uint32_t i, const Vec3& lower, const Vec3& upper) {
    for (int axis = 0; axis < 3; ++axis) {
        node.planes[axis][0][i] = round_down(lower[axis]);
        node.planes[axis][1][i] = round_up(upper[axis]);
    }
}

// The box around all children of another node. It is absent when all of those are.
inline void set_box_around(WideNode& node, std::uint32_t i, const WideNode& inner) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto& planes = inner.planes[axis];
        node.planes[axis][0][i] = *std::min_element(planes[0], planes[0] + wide_bvh_width);
        node.planes[axis][1][i] = *std::max_element(planes[1], planes[1] + wide_bvh_width);
    }
}

// Room for the blocks of so many triangles.
inline PageArray<BlockWord> make_words(std::size_t triangles) {
    const std::size_t words = words_per_triangle * triangles;
    PageArray<BlockWord> result(words + block_size);
    std::fill_n(result.data() + words, block_size, BlockWord{0.0f});
    return result;
}

// What is found out about a leaf while it is written.
struct WrittenLeaf {
    bool exact; // whether frame.from_frame gives every corner back
    Box box;    // in the coordinates of the frame
};

// Writes the leaves of a tree that has its frame and room for its words. Each thread needs one of its own.
class LeafWriter {
public:
    LeafWriter(WideBvh& bvh, const Primitives& primitives);

    // A leaf of `count` primitives that begins at triangle `first`.
    WrittenLeaf write(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count);

private:
    bool write_floats(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count, WrittenLeaf& written);
    const TriangleMesh& mesh_of(std::uint32_t primitive);

    BlockWord* const words_;
    const Primitives& primitives_;
    const SceneFrame frame_;
    // The scale as float32, where that and its inverse are normal numbers and the frame does not move anything; else zero.
    float scale_ = 0.0f;
    float inverse_scale_ = 0.0f;
    // The mesh looked at last, and the numbers of its triangles: neighbours are of one mesh, mostly.
    const TriangleMesh* mesh_ = nullptr;
    std::uint32_t mesh_first_ = 0;
    std::uint32_t mesh_count_ = 0;
};

} // namespace raywise
