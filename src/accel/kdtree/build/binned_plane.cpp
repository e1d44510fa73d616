#include "accel/kdtree/build/binned_plane.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace raywise {
namespace {

constexpr int bins = 32;
constexpr std::uint32_t most_sampled = 16384;

// How many boxes begin and end in each bin, on each axis. Neighbours in the list are counted apart, so that one need not wait for the
// other where they are in the same bin.
struct BinCounts {
    std::array<std::array<std::uint32_t, bins>, 3> begins[2] = {};
    std::array<std::array<std::uint32_t, bins>, 3> ends[2] = {};

    RW_INLINE void add(std::size_t copy, IntLanes lower, IntLanes upper) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            ++begins[copy][axis][static_cast<std::size_t>(lower[axis])];
            ++ends[copy][axis][static_cast<std::size_t>(upper[axis])];
        }
    }
    std::uint32_t begin(std::size_t axis, std::size_t bin) const { return begins[0][axis][bin] + begins[1][axis][bin]; }
    std::uint32_t end(std::size_t axis, std::size_t bin) const { return ends[0][axis][bin] + ends[1][axis][bin]; }
};

Bounds bounds_of(const BuildItem* items, std::uint32_t count) {
    Bounds bounds = Bounds::none();
    for (std::uint32_t i = 0; i < count; ++i) bounds.extend(Bounds::of(items[i]));
    return bounds;
}

// Bins per unit along each axis, 0 where there is but one; just below what would make the upper end a bin of its own.
Lanes bins_per_unit(const Bounds& bounds) {
    const Lanes size = bounds.upper - bounds.lower;
    Lanes scale = fill_lanes(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] > 0x1p-120f) scale[axis] = static_cast<float>(bins) * (1.0f - 0x1p-20f) / size[axis];
    }
    return scale;
}

class PlaneChoice {
public:
    explicit PlaneChoice(const KdCosts& costs) : costs_(costs) {}

    void consider(const CellAreas& areas, int axis, float position, std::uint32_t below, std::uint32_t above,
                  bool flat_below) {
        const auto plane = static_cast<double>(position);
        if (!areas.contains(plane)) return;
        const double tests = costs_.kept(below, above) *
                             (costs_.tests(below) * areas.below(plane) + costs_.tests(above) * areas.above(plane));
        if (tests < best.tests) best = {tests, axis, position, flat_below};
    }

    KdPlane best;

private:
    const KdCosts& costs_;
};

} // namespace

KdPlane find_binned_plane(const BuildItem* items, const KdTask& task, const KdCosts& costs) {
    const Bounds bounds = bounds_of(items, task.count);
    const Lanes scale = bins_per_unit(bounds);
    const std::uint32_t stride = 1 + task.count / most_sampled;
    BinCounts counts;
    std::uint32_t sampled = 0;
    for (std::uint32_t i = 0; i < task.count; i += stride, ++sampled) {
        const Bounds box = Bounds::of(items[i]);
        counts.add(sampled & 1u, __builtin_convertvector((box.lower - bounds.lower) * scale, IntLanes),
                   __builtin_convertvector((box.upper - bounds.lower) * scale, IntLanes));
    }
    const double weight = static_cast<double>(task.count) / sampled;
    const auto all_of = [&](std::uint32_t counted) {
        return stride == 1 ? counted : static_cast<std::uint32_t>(static_cast<double>(counted) * weight + 0.5);
    };

    PlaneChoice choice(costs);
    for (int axis = 0; axis < 3; ++axis) {
        const CellAreas areas(task.cell, axis);
        choice.consider(areas, axis, bounds.lower[axis], 0, task.count, false);
        choice.consider(areas, axis, bounds.upper[axis], task.count, 0, true);
        if (scale[axis] == 0.0f) continue;
        const auto a = static_cast<std::size_t>(axis);
        std::uint32_t below = 0;
        std::uint32_t above = sampled;
        for (std::size_t bin = 0; bin + 1 < bins; ++bin) {
            below += counts.begin(a, bin);
            above -= counts.end(a, bin);
            const float position = bounds.lower[axis] + static_cast<float>(bin + 1) / scale[axis];
            choice.consider(areas, axis, position, all_of(below), all_of(above), true);
        }
    }
    return choice.best;
}

} // namespace raywise
