// Bins along each axis (Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies"), and the best split
// between two of them.
#pragma once

#include "accel/bvh_build_bounds.h"
#include "accel/bvh_build_costs.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace raywise {

inline constexpr int no_axis = -1;

// How to split a node. `weight` is the sum over both children of half area times blocks of primitives.
struct BinSplit {
    double weight = std::numeric_limits<double>::infinity();
    int axis = no_axis;
    int bin = 0; // the first on the right
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
    int bin(const BuildItem& item, int axis) const {
        const int bin = static_cast<int>((item.centroid(axis) - lower_[axis]) * scale_[axis]);
        return bin < count_ ? bin : count_ - 1;
    }
    // On all three axes. The fourth lane is of no use, and may be anything before.
    IntLanes bins(const Bounds& bounds) const {
        const Lanes position = (bounds.centroid() - lower_) * scale_;
        return __builtin_convertvector(min_lanes(position, fill_lanes(static_cast<float>(count_ - 1))), IntLanes);
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
    static constexpr int count_for(std::uint32_t items) { return items < 32 ? 8 : items < 512 ? 16 : most; }

    explicit Bins(int count) : count_(count) {
        for (int axis = 0; axis < 3; ++axis) {
            std::fill_n(bounds_[axis], count, Bounds::none());
            std::fill_n(primitives_[axis], count, 0u);
        }
    }

    void add(const BuildItem& item, const Binning& binning) {
        const Bounds bounds = Bounds::of(item);
        const IntLanes bins = binning.bins(bounds);
        for (int axis = 0; axis < 3; ++axis) {
            bounds_[axis][bins[axis]].extend(bounds);
            primitives_[axis][bins[axis]] += item.count;
        }
    }
    void add(const Bins& other) {
        for (int axis = 0; axis < 3; ++axis) {
            for (int bin = 0; bin < count_; ++bin) {
                bounds_[axis][bin].extend(other.bounds_[axis][bin]);
                primitives_[axis][bin] += other.primitives_[axis][bin];
            }
        }
    }

    BinSplit best_split(const TreeCosts& costs) const {
        BinSplit best;
        for (int axis = 0; axis < 3; ++axis) {
            // From the right: bounds and numbers of the bins from each bin on.
            Bounds right_bounds[most];
            double right_weight[most];
            Bounds sum = Bounds::none();
            std::uint32_t primitives = 0;
            for (int bin = count_ - 1; bin > 0; --bin) {
                sum.extend(bounds_[axis][bin]);
                primitives += primitives_[axis][bin];
                right_bounds[bin] = sum;
                right_weight[bin] = primitives == 0 ? -1.0 : sum.half_area() * costs.blocks(primitives);
            }
            sum = Bounds::none();
            primitives = 0;
            for (int bin = 1; bin < count_; ++bin) {
                sum.extend(bounds_[axis][bin - 1]);
                primitives += primitives_[axis][bin - 1];
                if (primitives == 0 || right_weight[bin] < 0.0) continue;
                const double weight = sum.half_area() * costs.blocks(primitives) + right_weight[bin];
                if (weight < best.weight) best = {weight, axis, bin, sum, right_bounds[bin]};
            }
        }
        return best;
    }

private:
    int count_;
    Bounds bounds_[3][most];
    std::uint32_t primitives_[3][most];
};

} // namespace raywise
