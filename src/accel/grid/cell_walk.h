// The walk of a ray from cell to cell of a grid (Fujimoto, Tanaka, Iwata 1986, "ARTS: Accelerated Ray-Tracing System"; Amanatides and Woo
// 1987, "A Fast Voxel Traversal Algorithm for Ray Tracing").
//
// Why the walk cannot lose a hit. Let P be the point where the exact ray meets a primitive, at the exact distance t.
// - Along axis k the cells are parted by the planes 1 ... n - 1 (the faces of the bounds do not part cells). The walk
//   gives plane i the distance T(i) = a + i * b, a number that is computed the same way each time, grows with i (or
//   falls, for a backward direction) and puts the plane wrongly by at most 8 * 2^-53 * R along axis k, R being the
//   larger of the ray's distance from the bounds and their size: the rounding of T, divided by |1 / direction|, is
//   that of a difference of coordinates.
// - The walk crosses the planes of all three axes in the order of their T. So there is one moment at which it has
//   crossed exactly the planes with T <= t, and the cell it is in then holds P but for 8 * 2^-53 * R along each axis.
// - Primitives are listed in every cell that they come nearer to than half of overlap_slack cells
//   (triangle_box_overlap.h). As long as that is more than the error, the primitive is in that cell's list: 2^-17 of
//   a cell's width against 2^-50 * R. R is at most 8 sizes of the bounds, because rays from farther away are moved (ray/cell_ray.h), and
//   there are at most 2^24 cells along an axis.
// - The walk starts in a cell whose planes behind it have T below the ray's first possible hit, and ends when the
//   next plane lies beyond the last possible one, both by the ray's margin (ray/cell_ray.h). So the moment lies between start and end.
#pragma once

#include "accel/grid/cell_lattice.h"
#include "ray/cell_ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace raywise {

class CellWalk {
public:
    CellWalk(const CellRay& ray, const CellLattice& lattice) : last_s_(ray.last) {
        double near = ray.first;
        for (int axis = 0; axis < 3; ++axis) {
            const double lower = lattice.bounds.lower[axis];
            const double upper = lattice.bounds.upper[axis];
            if (std::fabs(ray.direction[axis]) <= still) {
                // Moved by less than that, and rounded when the ray was.
                const double slack = 0x1p-50 * max_component(magnitudes(ray.start - lattice.bounds.center())) +
                                     0x1p-50 * max_component(lattice.bounds.size());
                if (ray.start[axis] < lower - slack || ray.start[axis] > upper + slack) return;
                continue;
            }
            const Interval slab = ray.slab(axis, lower, upper);
            near = std::max(near, slab.near);
            last_s_ = std::min(last_s_, slab.far);
        }
        enters_ = near <= last_s_;
        if (!enters_) return;
        for (int axis = 0; axis < 3; ++axis) {
            Course& course = axis == 0 ? x_ : axis == 1 ? y_ : z_;
            course.begin(ray, lattice, axis, near);
            cell_ += course.number;
        }
    }

    // Whether the ray meets the box of all cells at all; else there is no cell.
    bool enters() const { return enters_; }
    std::uint32_t cell() const { return cell_; } // its number
    // No hit behind s is of use any more.
    void end_at(double s) { last_s_ = std::min(last_s_, s); }

    // To the next cell. Returns false at the end. Branches tell the axis, not a table of three courses: what is guessed right costs
    // nothing, and the courses stay in registers (a sixth of the time of random rays through the bunny).
    bool step() {
        if (x_.next <= y_.next) return x_.next <= z_.next ? cross(x_) : cross(z_);
        return y_.next <= z_.next ? cross(y_) : cross(z_);
    }

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    // A component so small moves the ray by less than 2^-60 of the scene's distance: nothing, against the slack of
    // the lists.
    static constexpr double still = 0x1p-60;

    // Along one axis.
    struct Course {
        double next = infinity; // T of the next plane; infinite after the last
        double plane = 0.0;     // its number
        double last = 0.0;      // the number of the face behind the last plane
        double step = 0.0;      // 1 or -1
        double a = 0.0;         // T(i) = a + i * b
        double b = 0.0;
        std::int32_t place = 0; // of the cell along the axis
        std::int32_t place_step = 0;
        std::uint32_t number = 0; // what the place adds to the cell's number
        AxisNumbers numbers;

        void begin(const CellRay& ray, const CellLattice& lattice, int axis, double start) {
            const std::uint32_t count = lattice.resolution[static_cast<std::size_t>(axis)];
            if (count == 1) return;
            const double d = ray.direction[axis];
            const double lower = lattice.bounds.lower[axis];
            const double highest = count - 1.0;
            const bool moves = std::fabs(d) > still;
            const double position =
                ((ray.start[axis] - lower) + (moves ? start * d : 0.0)) * lattice.cells_per_unit[axis];
            double at = std::floor(std::min(std::max(position, 0.0), highest));
            if (moves) {
                a = (lower - ray.start[axis]) * ray.inverse[axis];
                b = lattice.width[axis] * ray.inverse[axis];
                // The rounded position may be a plane too far ahead.
                if (d > 0.0) {
                    while (at > 0.0 && distance(at) > start) at -= 1.0;
                    step = 1.0;
                    plane = at + 1.0;
                    last = count;
                } else {
                    while (at < highest && distance(at + 1.0) > start) at += 1.0;
                    step = -1.0;
                    plane = at;
                    last = 0.0;
                }
                place_step = d > 0.0 ? 1 : -1;
                if (plane != last) next = distance(plane);
            }
            numbers = lattice.numbers[static_cast<std::size_t>(axis)];
            place = static_cast<std::int32_t>(at);
            number = numbers(static_cast<std::uint32_t>(place));
        }
        double distance(double i) const { return a + i * b; }
    };

    bool cross(Course& course) {
        if (course.next > last_s_) return false; // which is finite: the walk ends
        course.place += course.place_step;
        const std::uint32_t number = course.numbers(static_cast<std::uint32_t>(course.place));
        cell_ += number - course.number;
        course.number = number;
        course.plane += course.step;
        course.next = course.plane == course.last ? infinity : course.distance(course.plane);
        return true;
    }

    Course x_, y_, z_;
    std::uint32_t cell_ = 0;
    double last_s_; // the s behind which no hit is of use
    bool enters_ = false;
};

} // namespace raywise
