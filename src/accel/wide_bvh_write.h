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

// A child without a box, too, because nothing in it can be hit any more.
inline bool is_absent(const WideNode& node, std::uint32_t i) { return node.planes[0][0][i] == absent_plane; }

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

// Writes the blocks of a leaf that begins at triangle `first` and has `count` primitives. Calls visit(corner) for each corner, in the
// coordinates of the frame. Returns whether frame.from_frame gives all of them back.
template <class Visit>
bool write_leaf(WideBvh& bvh, const Primitives& primitives, std::uint32_t first, const std::uint32_t* leaf,
                std::uint32_t count, const Visit& visit) {
    bool exact = true;
    for (std::uint32_t begin = 0; begin < count; begin += block_size) {
        const std::uint32_t n = std::min(block_size, count - begin);
        BlockWord* const block = bvh.words.data() + words_per_triangle * (std::size_t{first} + begin);
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t primitive = leaf[begin + i];
            const Corners corners = primitives.corners(primitive);
            for (std::uint32_t k = 0; k < 3; ++k) {
                const Vec3 p = bvh.frame.to_frame(corners[k]);
                visit(p);
                for (int axis = 0; axis < 3; ++axis)
                    block[(3 * k + static_cast<std::uint32_t>(axis)) * n + i].coordinate = static_cast<float>(p[axis]);
            }
            block[9 * n + i].primitive = primitive;
            exact = exact && BlockTriangle{block, n, i}.corners(bvh.frame) == corners;
        }
    }
    return exact;
}

} // namespace raywise
