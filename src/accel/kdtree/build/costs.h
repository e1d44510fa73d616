// What a ray is taken to cost in a kd-tree: the surface area heuristic (MacDonald and Booth 1990), with leaves that test several primitives at
// once.
#pragma once

#include "accel/accel.h"
#include "accel/kdtree/options.h"
#include "base/box.h"

#include <cstdint>

namespace raywise {

// A step from plane to plane counts as so many of BuildCosts::node_step_ns. Planes are compared with a ray in threes, one below the other, but the
// last of a branch have fewer below them, and what is deep in the tree is far from the caches. With the default costs, at 2, 4, 8 and 12
// random rays through the bunny take 233, 221, 206 and 227 ns, through a soup of 10^6 small triangles 1700, 1606, 1450 and 1600; building the
// bunny takes 94, 72, 53 and 45 ms (kd-tree of one thread on an AMD EPYC with AVX-512, 2026-12-01; docs/decisions/0024-kd-tree.md).
inline constexpr double kd_step_weight = 8.0;

class KdCosts {
public:
    KdCosts(const BuildCosts& costs, const KdTreeOptions& options)
        : step(options.step_cost > 0.0 ? options.step_cost : kd_step_weight * costs.node_step_ns),
          test(options.test_cost > 0.0 ? options.test_cost : costs.primitive_test_ns),
          tested_at_once_(options.tested_at_once),
          kept_for_empty_(1.0 - options.empty_bonus) {}

    double tests(std::uint32_t primitives) const {
        return static_cast<double>((primitives + tested_at_once_ - 1) / tested_at_once_);
    }
    double leaf(std::uint32_t primitives) const { return test * tests(primitives); }
    // What a split's tests count, a side without primitives making them cheaper.
    double kept(std::uint32_t below, std::uint32_t above) const {
        return below == 0 || above == 0 ? kept_for_empty_ : 1.0;
    }

    double step;
    double test; // of as many primitives as are tested at once

private:
    std::uint32_t tested_at_once_;
    double kept_for_empty_;
};

// Half the surface of the two parts of a cell as a function of where the plane is.
struct CellAreas {
    CellAreas(const Box& cell, int axis) : lower(cell.lower[axis]), upper(cell.upper[axis]) {
        const Vec3 size = cell.size();
        const double a = size[(axis + 1) % 3];
        const double b = size[(axis + 2) % 3];
        across = a * b;
        around = a + b;
    }
    bool contains(double plane) const { return plane > lower && plane < upper; }
    double below(double plane) const { return across + around * (plane - lower); }
    double above(double plane) const { return across + around * (upper - plane); }

    double lower;
    double upper;
    double across;
    double around;
};

} // namespace raywise
