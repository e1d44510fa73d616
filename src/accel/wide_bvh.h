// A bounding volume hierarchy with eight children to a node, and triangles in blocks of at most eight: what a vector register
// compares at once (Wald, Benthin, Boulos 2008, "Getting Rid of Packets"; Dammertz, Hanika, Keller 2008, "Shallow Bounding Volume
// Hierarchies").
#pragma once

#include "accel/bvh_build.h"
#include "accel/scene_frame.h"
#include "base/page_array.h"
#include "base/parallel.h"
#include "geometry/primitives.h"

#include <cstddef>
#include <cstdint>

namespace raywise {

inline constexpr std::uint32_t wide_bvh_width = 8;

// What a child of a node is, in one word: a node by its index, or a leaf by the place of its first triangle among all and their
// number.
class WideReference {
public:
    WideReference() = default;
    static WideReference node(std::uint32_t index) { return WideReference(index); }
    static WideReference leaf(std::uint32_t first, std::uint32_t triangles) {
        return WideReference(std::uint64_t{triangles} << 32 | first);
    }

    bool is_leaf() const { return bits_ >> 32 != 0; }
    std::uint32_t index() const { return static_cast<std::uint32_t>(bits_); } // of the node, or of the first triangle
    std::uint32_t triangles() const { return static_cast<std::uint32_t>(bits_ >> 32); }

private:
    explicit WideReference(std::uint64_t bits) : bits_(bits) {}

    std::uint64_t bits_;
};

// Four cache lines: eight boxes in the coordinates of the frame, rounded outwards, and what is in them. An absent child's box has its
// planes in the wrong order, so far apart that no ray meets it.
struct alignas(64) WideNode {
    float planes[3][2][wide_bvh_width]; // on each axis: lower and upper
    WideReference child[wide_bvh_width];
};
static_assert(sizeof(WideNode) == 256);

inline constexpr float absent_plane = 0x1p100f; // lower; upper is its negative
// A child without a box, too, because nothing in it can be hit any more.
inline bool is_absent(const WideNode& node, std::uint32_t i) { return node.planes[0][0][i] == absent_plane; }

// Triangles lie in the order of the leaves. Each leaf is cut into blocks of eight triangles and a last one of n <= 8; a block is nine
// lines of n coordinates, x y z of the first corners, then of the second and the third, and a line of n primitive numbers. So
// triangles take ten words each, and a block of a leaf that begins at triangle f begins at word 10 f.
inline constexpr std::size_t words_per_triangle = 10;
inline constexpr std::uint32_t block_size = 8;

union BlockWord {
    float coordinate;
    std::uint32_t primitive;
};

// In its leaves are the primitives that can be hit, all of them and no others.
struct WideBvh {
    SceneFrame frame;
    PageArray<WideNode> nodes;  // the root first, every other one behind its parent; none when nothing can be hit
    PageArray<BlockWord> words; // and as many more as a vector reads beyond the last block
    bool exact = false;         // whether frame.from_frame gives every corner back without loss
    bool repeats = false;       // whether a primitive may be in several leaves
    double built_cost = 0.0;    // tree_cost() when it was built; geometry may have moved since (wide_bvh_refit.h)

    std::size_t bytes() const { return nodes.bytes() + words.bytes(); }
    // The block that begins with a triangle.
    const BlockWord* block(std::size_t triangle) const { return &words[words_per_triangle * triangle]; }
};

// Triangle i of a block of n.
struct BlockTriangle {
    const BlockWord* block;
    std::uint32_t n;
    std::uint32_t i;

    std::uint32_t primitive() const { return block[9 * n + i].primitive; }
    // As good as float32 tells: see WideBvh::exact.
    Corners corners(const SceneFrame& frame) const { return {corner(frame, 0), corner(frame, 1), corner(frame, 2)}; }

private:
    Vec3 corner(const SceneFrame& frame, std::uint32_t k) const {
        const BlockWord* const x = block + 3 * k * n + i;
        return frame.from_frame({static_cast<double>(x[0].coordinate), static_cast<double>(x[n].coordinate),
                                 static_cast<double>(x[2 * n].coordinate)});
    }
};

// What a ray that meets the scene is taken to cost, in steps from node to node, a block of triangles for one: the surface area
// heuristic over the whole tree. Zero for one without anything in it.
double tree_cost(const WideBvh& bvh, const Parallel& parallel);

// Makes it of a binary tree. Reports progress from progress_begin to 1.
WideBvh widen(const BvhTree& tree, const BuildInput& input, double progress_begin);

} // namespace raywise
