// A kd-tree as it is built: nodes with two children, and references to primitives in the leaves. What rays are traced through is made of it
// (accel/kdtree/treelets.h).
#pragma once

#include "base/page_array.h"
#include "ray/scene_frame.h"

#include <cstdint>
#include <cstring>

namespace raywise {

// 8 bytes, as in pbrt (Chuang's lecture, "Tree representation").
class KdNode {
public:
    static KdNode inner(int axis, float split, std::uint32_t child) {
        KdNode node;
        std::memcpy(&node.data_, &split, sizeof split);
        node.link_ = child << 2 | static_cast<std::uint32_t>(axis);
        return node;
    }
    // first: where its references begin.
    static KdNode leaf(std::uint32_t first, std::uint32_t count) {
        KdNode node;
        node.data_ = first;
        node.link_ = count << 2 | 3u;
        return node;
    }

    bool is_leaf() const { return (link_ & 3u) == 3u; }
    int axis() const { return static_cast<int>(link_ & 3u); }
    // The side below the split; the one above is next to it.
    std::uint32_t child() const { return link_ >> 2; }
    float split() const {
        float split;
        std::memcpy(&split, &data_, sizeof split);
        return split;
    }
    std::uint32_t first() const { return data_; }
    std::uint32_t count() const { return link_ >> 2; }

    // For joining trees.
    void move_child(std::uint32_t by) { link_ += by << 2; }
    void move_first(std::uint32_t by) { data_ += by; }

private:
    std::uint32_t data_ = 0; // split, or first reference
    std::uint32_t link_ = 3; // child or count, and below it 0, 1, 2: the axis of an inner node; 3: a leaf
};
static_assert(sizeof(KdNode) == 8);

// No deeper than this, whatever the scene: the walk's stack has so many places.
inline constexpr int most_kd_levels = 64;

// Planes are numbers of float32 in the frame.
struct KdTreeData {
    SceneFrame frame;
    PageVector<KdNode> nodes; // the root is the first; empty without hittable primitives
    PageVector<std::uint32_t> references;
    bool too_large = false; // see KdTreeOptions::most_numbers
};

} // namespace raywise
