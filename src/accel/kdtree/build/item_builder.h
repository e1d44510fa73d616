// The upper levels of a kd-tree, from a list of boxes: a node's list is cut in two at a plane, primitives on both sides are in both.
#pragma once

#include "accel/kdtree/build/context.h"
#include "accel/kdtree/build/event_builder.h"
#include "accel/kdtree/build/task.h"
#include "base/page_array.h"

#include <cstdint>

namespace raywise {

// A subtree that is built apart from the others.
struct KdPart {
    KdTask task;
    PageVector<BuildItem> items;
    std::uint32_t node; // its place in the tree above
};

class KdItemBuilder {
public:
    // items: of the root.
    KdItemBuilder(const KdContext& context, PageVector<BuildItem> items);

    // Builds all of it.
    KdOutput build(const KdTask& root);
    // Leaves nodes of at most `part_size` primitives to be built later, and so those that no plane makes cheaper.
    KdOutput build_top(const KdTask& root, std::uint32_t part_size, PageVector<KdPart>& parts);

private:
    // The items of the task are those from `begin` to the end of the list, and are used up. Returns the expected cost of a ray that meets
    // the node.
    double build(const KdTask& task, std::uint32_t node, std::size_t begin);
    double split(const KdTask& task, const KdPlane& plane, bool is_bad, std::uint32_t node, std::size_t begin);
    KdPlane find_plane(const KdTask& task, std::size_t begin);
    void partition(const KdTask& task, const KdPlane& plane, std::size_t begin, KdSides& sides);
    template <bool flat_below>
    void partition_along(const KdTask& task, const KdPlane& plane, std::size_t begin, KdSides& sides);
    void put_aside(const KdTask& task, std::uint32_t node, std::size_t begin);
    double make_leaf(std::uint32_t node, std::size_t begin);
    PageVector<std::uint32_t> primitives_from(std::size_t begin) const;

    const KdContext& context_;
    KdOutput output_;
    KdEventBuilder event_builder_; // of small nodes
    PageVector<BuildItem> items_;
    PageVector<BuildItem> above_; // the upper side of a node being split
    PageVector<KdPart>* parts_ = nullptr;
    std::uint32_t part_size_ = 0;
};

} // namespace raywise
