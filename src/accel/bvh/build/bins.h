// Bins along each axis (Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies"), and the best split
// between two of them.
#pragma once

#include "accel/bvh/build/bounds.h"
#include "accel/bvh/build/costs.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace raywise {

inline constexpr int no_axis = -1;

// How to split a node. `weight` is the sum over both children of half area, in units of the square of the node's size,
// times blocks of primitives.
struct BinSplit {
    float weight = std::numeric_limits<float>::infinity();
    int axis = no_axis;
    int bin = 0; // the first on the right
    std::uint32_t left_primitives = 0;
    Bounds left = Bounds::none();
    Bounds right = Bounds::none();
};

// From a centroid to its bin on each axis; monotone. An axis on which the centroids agree, or are so close or so far
// apart that float32 cannot divide the axis, has the one bin 0.
class Binning {
public:
    Binning(const Bounds& centroids, int count) : count_(count) {
        for (int axis = 0; axis < 3; ++axis) {
            const float extent = centroids.upper[axis] - centroids.lower[axis];
            const bool divides = extent > 1e-36f && extent <= std::numeric_limits<float>::max();
            lower_[axis] = divides ? centroids.lower[axis] : 0.0f; // no infinite difference
            scale_[axis] = divides ? static_cast<float>(count) / extent : 0.0f;
        }
    }
    // Where the centroid lies between the bins on each axis. The fourth lane is of no use.
    RW_INLINE Lanes position(const Lanes& centroid) const { return (centroid - lower_) * scale_; }
    RW_INLINE IntLanes bins(const Bounds& bounds) const {
        return __builtin_convertvector(
            min_lanes(position(bounds.centroid()), fill_lanes(static_cast<float>(count_ - 1))), IntLanes);
    }
    int count() const { return count_; }

private:
    int count_;
    Lanes lower_{};
    Lanes scale_{};
};

// The bins in use, of each axis.
class Bins {
public:
    static constexpr int most = 32;
    // The more items, the more it pays to look closely.
    static constexpr int count_for(std::uint32_t items) {
        return static_cast<int>(std::min<std::uint32_t>(most, 6 + items / 12));
    }

    explicit Bins(int count) : count_(count) {
        for (int axis = 0; axis < 3; ++axis) {
            std::fill_n(bounds_[axis], count, Bounds::none());
        }
        std::fill_n(primitives_, count, CountLanes{});
    }

    RW_INLINE void add(const BuildItem& item, const Binning& binning) {
        const Bounds bounds = Bounds::of(item);
        const IntLanes bins = binning.bins(bounds);
        for (int axis = 0; axis < 3; ++axis) {
            bounds_[axis][bins[axis]].extend(bounds);
            primitives_[bins[axis]][axis] += item.count;
        }
    }
    void add(const Bins& other) {
        for (int axis = 0; axis < 3; ++axis) {
            for (int bin = 0; bin < count_; ++bin) {
                bounds_[axis][bin].extend(other.bounds_[axis][bin]);
            }
        }
        for (int bin = 0; bin < count_; ++bin) primitives_[bin] += other.primitives_[bin];
    }

    // bounds: of all items. They make one the unit of length, so that areas neither overflow nor underflow where it
    // matters.
    RW_INLINE BinSplit best_split(const Bounds& bounds, const TreeCosts& costs) const {
        const Lanes unit = fill_lanes(bounds.reciprocal_size());
        // All three axes at once, a lane for each. From the right: what is in the bins from each bin on, weighed.
        Lanes right_weights[most];
        Bounds sums[3] = {Bounds::none(), Bounds::none(), Bounds::none()};
        CountLanes primitives{};
        for (int bin = count_ - 1; bin > 0; --bin) {
            for (int axis = 0; axis < 3; ++axis) sums[axis].extend(bounds_[axis][bin]);
            primitives += primitives_[bin];
            right_weights[bin] = weigh(sums, primitives, unit, costs);
        }
        for (Bounds& sum : sums) sum = Bounds::none();
        primitives = CountLanes{};
        Lanes best_weights = fill_lanes(std::numeric_limits<float>::infinity());
        IntLanes best_bins{};
        for (int bin = 1; bin < count_; ++bin) {
            for (int axis = 0; axis < 3; ++axis) sums[axis].extend(bounds_[axis][bin - 1]);
            primitives += primitives_[bin - 1];
            const Lanes weights = weigh(sums, primitives, unit, costs) + right_weights[bin];
            // A side without items weighs infinity times zero, a NaN, and that is never better.
            const IntLanes better = weights < best_weights;
            best_weights = min_lanes(weights, best_weights);
            best_bins = (better & bin) | (~better & best_bins);
        }
        BinSplit best;
        for (int axis = 0; axis < 3; ++axis) {
            if (best_weights[axis] < best.weight) {
                best.weight = best_weights[axis];
                best.axis = axis;
                best.bin = best_bins[axis];
            }
        }
        if (best.axis == no_axis) return best;
        for (int bin = 0; bin < count_; ++bin) {
            (bin < best.bin ? best.left : best.right).extend(bounds_[best.axis][bin]);
            if (bin < best.bin) best.left_primitives += primitives_[bin][best.axis];
        }
        return best;
    }

private:
    // Half area times blocks of primitives, of what is left of a bin on each axis, or right.
    RW_INLINE static Lanes weigh(const Bounds* sums, const CountLanes& primitives, const Lanes& unit,
                                 const TreeCosts& costs) {
        const Lanes a = sums[0].upper * unit - sums[0].lower * unit;
        const Lanes b = sums[1].upper * unit - sums[1].lower * unit;
        const Lanes c = sums[2].upper * unit - sums[2].lower * unit;
        // From the extents of each axis' box to those of all three boxes along x, along y and along z.
        const Lanes ab_xy = __builtin_shufflevector(a, b, 0, 4, 1, 5);
        const Lanes x = __builtin_shufflevector(ab_xy, c, 0, 1, 4, 4);
        const Lanes y = __builtin_shufflevector(ab_xy, c, 2, 3, 5, 5);
        const Lanes z = __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 6, 2, 6), c, 0, 1, 6, 6);
        const CountLanes blocks = (primitives + (costs.block_size - 1)) >> costs.log2_block_size;
        return (x * (y + z) + y * z) * __builtin_convertvector(blocks, Lanes);
    }

    int count_;
    Bounds bounds_[3][most];
    CountLanes primitives_[most];
};

} // namespace raywise
