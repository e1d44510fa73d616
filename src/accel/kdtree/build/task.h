// A node of a kd-tree that is yet to be built, and the plane that it is to be split at.
#pragma once

#include "base/box.h"

#include <cstdint>
#include <limits>

namespace raywise {

struct KdTask {
    Box cell;
    std::uint32_t count;     // primitives
    std::uint64_t allowance; // references that its leaves may have, at least count
    int level;               // 0: the root
    int bad_splits;          // on the way to it
};

struct KdPlane {
    double tests = std::numeric_limits<double>::infinity(); // half areas times tests, of both sides, less the bonus
    int axis = -1;                                          // -1: there is none
    float position = 0.0f;
    bool flat_below = true; // which side primitives that lie in the plane go to

    bool found() const { return axis >= 0; }
};

// The two sides of a task; their counts have to be set before the allowance can be shared.
struct KdSides {
    KdSides(const KdTask& task, const KdPlane& plane, int bad_splits) : below(task), above(task) {
        below.cell.upper[plane.axis] = static_cast<double>(plane.position);
        above.cell.lower[plane.axis] = static_cast<double>(plane.position);
        below.level = above.level = task.level + 1;
        below.bad_splits = above.bad_splits = bad_splits;
    }

    std::uint64_t count() const { return std::uint64_t{below.count} + above.count; }

    // In proportion to the primitives. Returns false where they are more than the task is allowed.
    bool share_allowance(const KdTask& task) {
        if (count() > task.allowance) return false;
        const std::uint64_t spare = task.allowance - count();
        const double part = count() == 0 ? 0.0 : static_cast<double>(below.count) / static_cast<double>(count());
        below.allowance = below.count + static_cast<std::uint64_t>(static_cast<double>(spare) * part);
        above.allowance = task.allowance - below.allowance;
        return true;
    }

    KdTask below;
    KdTask above;
};

} // namespace raywise
