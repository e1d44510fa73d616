// A bounding volume hierarchy with eight children to a node, and triangles in blocks of at most eight: what a vector register
// compares at once (Wald, Benthin, Boulos 2008, "Getting Rid of Packets"; Dammertz, Hanika, Keller 2008, "Shallow Bounding Volume
// Hierarchies").
#pragma once

#include "base/page_array.h"
#include "base/parallel.h"
#include "geometry/primitives.h"
#include "geometry/triangle_block.h"
#include "ray/scene_frame.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace raywise {

inline constexpr std::uint32_t wide_bvh_width = 8;

// What a child of a node is, in one word: a node by its index, or a leaf by the index of its first triangle among all, their number, and how
// far they lie from the center of the frame.
class NodeRef {
public:
    NodeRef() = default;
    static NodeRef node(std::uint32_t index) { return NodeRef(index); }
    // distance: of the corners from the center, along any axis, in the scene's unit; kept as the next power of two above it.
    static NodeRef leaf(std::uint32_t first, std::uint32_t triangles, double distance) {
        std::uint64_t bits; // ilogb and ldexp take longer than the rest of a leaf
        std::memcpy(&bits, &distance, sizeof bits);
        const int exponent = static_cast<int>(bits >> 52) - 1022;
        const auto biased = static_cast<std::uint64_t>(std::max(exponent, least_exponent) - least_exponent);
        return NodeRef(biased << 54 | std::uint64_t{triangles} << 32 | first);
    }
    static constexpr std::uint32_t most_triangles = (1u << 22) - 1;

    bool is_leaf() const { return bits_ >> 32 != 0; }
    std::uint32_t index() const { return static_cast<std::uint32_t>(bits_); } // of the node, or of the first triangle
    std::uint32_t triangles() const { return static_cast<std::uint32_t>(bits_ >> 32) & most_triangles; }
    // Some of a leaf's triangles, from the first one named on.
    NodeRef part(std::uint32_t first, std::uint32_t triangles) const {
        return NodeRef((bits_ >> 54) << 54 | std::uint64_t{triangles} << 32 | (index() + first));
    }
    double distance() const {
        const std::uint64_t bits = ((bits_ >> 54) + static_cast<std::uint64_t>(1023 + least_exponent)) << 52;
        double result;
        std::memcpy(&result, &bits, sizeof result);
        return result;
    }

private:
    explicit NodeRef(std::uint64_t bits) : bits_(bits) {}

    // Corners are below 2^129 from any center, and 2^-800 is as good as nothing beside a ray's origin.
    static constexpr int least_exponent = -800;

    std::uint64_t bits_;
};

// Four cache lines: eight boxes in the coordinates of the frame, rounded outwards and wider by what hits may be off by
// (ray/traversal_ray.h), and what is in them. An empty child's box has its planes in the wrong order, so far apart that no ray meets it.
struct alignas(64) WideNode {
    float planes[3][2][wide_bvh_width]; // on each axis: lower and upper
    NodeRef child[wide_bvh_width];
};
static_assert(sizeof(WideNode) == 256);

inline constexpr float empty_plane = 0x1p100f; // lower; upper is its negative
// A child without a box, too, because nothing in it can be hit any more.
inline bool is_empty_child(const WideNode& node, std::uint32_t i) { return node.planes[0][0][i] == empty_plane; }

// In its leaves are the primitives that can be hit, all of them and no others. Leaves lie in the order of the tree; each is cut into blocks of
// eight triangles and a last one of n <= 8 (geometry/triangle_block.h), of float32 where all meshes are, else of float64.
struct WideBvh {
    SceneFrame frame;
    PageArray<WideNode> nodes;   // the root first, every other one behind its parent; none when nothing can be hit
    PageArray<std::byte> blocks; // and triangle_block_padding
    bool is_float64 = false;
    bool repeats = false; // whether a primitive may be in several leaves
    // Of one that was refitted: tree_cost() when it was built. Zero for one as it was built: adding up the areas of all boxes takes a fiftieth
    // of the time of a Morton build, and hardly anybody asks.
    double built_cost = 0.0;

    std::size_t bytes() const { return nodes.bytes() + blocks.bytes(); }
    std::size_t bytes_per_triangle() const { return block_bytes_per_triangle(is_float64); }
    std::size_t triangle_count() const { return (blocks.size() - triangle_block_padding) / bytes_per_triangle(); }
    // The block that begins with a triangle.
    const std::byte* block(std::size_t triangle) const { return blocks.data() + bytes_per_triangle() * triangle; }
};

// Calls visit(block) for the blocks of a leaf.
template <class T, class Visit>
void for_each_block(const WideBvh& bvh, NodeRef leaf, const Visit& visit) {
    for (std::uint32_t begin = 0; begin < leaf.triangles(); begin += triangle_block_size) {
        visit(TriangleBlock<T>{
            bvh.blocks.data() + TriangleBlock<T>::bytes_per_triangle * (std::size_t{leaf.index()} + begin),
            std::min(triangle_block_size, leaf.triangles() - begin)});
    }
}

// What a ray that meets the scene is taken to cost, in steps from node to node, a block of triangles for one: the surface area
// heuristic over the whole tree. Zero for one without anything in it.
double tree_cost(const WideBvh& bvh, const Parallel& parallel);

} // namespace raywise
