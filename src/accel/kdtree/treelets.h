// The kd-tree as rays are traced through it: three levels of planes and the eight cells between them in one cache line, eight bytes for each
// plane and its share of the links, compared with a ray all at once; and leaves as blocks of triangles.
#pragma once

#include "accel/accel.h"
#include "accel/kdtree/build/binary_tree.h"
#include "base/box.h"
#include "base/page_array.h"
#include "geometry/primitives.h"
#include "geometry/triangle_block.h"
#include "ray/scene_frame.h"

#include <cstddef>
#include <cstdint>

namespace raywise {

// What is in a cell: more planes, or a leaf.
class KdLink {
public:
    KdLink() = default;
    static KdLink treelet(std::uint32_t index) { return KdLink(index); }
    static KdLink leaf(std::size_t offset) {
        return KdLink(leaf_bit | static_cast<std::uint32_t>(offset / leaf_alignment));
    }

    bool is_leaf() const { return (bits_ & leaf_bit) != 0; }
    std::uint32_t index() const { return bits_; }                                          // of the treelet
    std::size_t offset() const { return std::size_t{bits_ & ~leaf_bit} * leaf_alignment; } // of the leaf, in bytes

    static constexpr std::size_t leaf_alignment = 8;
    static constexpr std::size_t most_leaf_bytes = (std::size_t{1} << 31) * leaf_alignment;

private:
    explicit KdLink(std::uint32_t bits) : bits_(bits) {}
    static constexpr std::uint32_t leaf_bit = 1u << 31;

    std::uint32_t bits_; // not initialised: stacks are full of them
};

inline constexpr std::uint32_t treelet_cells = 8;
inline constexpr std::uint32_t treelet_planes = treelet_cells - 1;
inline constexpr int treelet_levels = 3;

// Plane 0 is the root, plane i parts what is below and above it with the planes 2 i + 1 and 2 i + 2; the cells follow in the same way: cell 0 is
// below planes 0, 1 and 3. A leaf or nothing at all higher up is the first of the cells it stands for, below planes that everything is below;
// the others are not there.
struct alignas(64) KdTreelet {
    float split[treelet_planes];
    std::uint32_t shape; // read with the splits, as if it was one: a normal number
    KdLink cell[treelet_cells];

    static constexpr float no_plane = 0x1p100f;
    static constexpr std::uint32_t present_shift =
        14; // below are two bits for each plane's axis, above a bit for each cell that is there
    static constexpr std::uint32_t shape_of_none = 0x20000000u;

    int axis(std::uint32_t plane) const { return static_cast<int>(shape >> 2 * plane & 3u); }
    std::uint32_t present() const { return shape >> present_shift & 0xFFu; }
};
static_assert(sizeof(KdTreelet) == 64);

// A leaf begins with this; its triangles follow in blocks of eight and a last one of n <= 8 (geometry/triangle_block.h), of float32 where all
// meshes are, else of float64.
struct KdLeafHead {
    float distance; // no corner is farther from the center of the frame along any axis; in the scene's unit
    std::uint32_t count;
};
static_assert(sizeof(KdLeafHead) == KdLink::leaf_alignment);

struct KdTreelets {
    SceneFrame frame;
    BoxF bounds;                   // of what is in it, in the frame, rounded outwards
    float hit_error = 0.0f;        // what a hit's distance may be off by, in the frame: see traverse-inl.h
    PageArray<KdTreelet> treelets; // the root first; none when nothing can be hit
    PageArray<std::byte> leaves;   // and triangle_block_padding
    bool is_float64 = false;
    bool too_large = false; // for links; there is no tree then

    std::size_t bytes() const { return treelets.bytes() + leaves.bytes(); }
};

// progress_begin: what is reported first; it goes up to 1.
KdTreelets make_treelets(const KdTreeData& tree, const BuildInput& input, double progress_begin);

} // namespace raywise
