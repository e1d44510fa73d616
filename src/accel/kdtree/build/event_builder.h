// The lower levels of a kd-tree, in O(n log n): every plane that may be best is considered, by sweeps over sorted events, which stay sorted from
// node to node (Wald and Havran 2006, "On Building Fast kd-Trees for Ray Tracing, and on Doing That in O(N log N)", section 4.3).
#pragma once

#include "accel/kdtree/build/context.h"
#include "accel/kdtree/build/events.h"
#include "accel/kdtree/build/task.h"
#include "base/page_array.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace raywise {

class KdEventBuilder {
public:
    // output: where nodes and leaves go.
    KdEventBuilder(const KdContext& context, KdOutput& output) : context_(context), output_(output) {}

    // Builds the subtree of a task with task.count items below a node. Returns the expected cost of a ray that meets it.
    double build(const BuildItem* items, const KdTask& task, std::uint32_t node);

private:
    using Begin = std::array<std::size_t, 3>;
    enum Side : std::uint8_t {
        below,
        above,
        both
    };

    double build(const KdTask& task, std::uint32_t node, const Begin& begin);
    double split(const KdTask& task, const KdPlane& plane, bool is_bad, std::uint32_t node, const Begin& begin);
    KdPlane find_plane(const KdTask& task, const Begin& begin) const;
    void classify(const KdPlane& plane, const Begin& begin);
    void cut(const KdTask& task, const KdPlane& plane, const Begin& begin, KdSides& sides);
    Begin distribute(const Begin& begin);
    double make_leaf(std::uint32_t node, const Begin& begin);
    void list_primitives(const Begin& begin, PageVector<std::uint32_t>& list) const;

    const KdContext& context_;
    KdOutput& output_;
    // The events of a node are those from some place to the ends of the lists.
    KdEventLists events_;
    PageVector<std::uint32_t> primitives_; // by number
    PageVector<Side> sides_;               // by number
    // Of the upper side of a node being split, and of the parts of what is cut.
    PageVector<KdEvent> above_;
    KdEventLists new_below_;
    KdEventLists new_above_;
    PageVector<std::uint32_t> leaf_;
};

} // namespace raywise
