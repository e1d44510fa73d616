// The walk of a ray from cell to cell of a grid (Fujimoto, Tanaka, Iwata 1986, "ARTS: Accelerated Ray-Tracing System"; Amanatides and Woo
// 1987, "A Fast Voxel Traversal Algorithm for Ray Tracing"), on two levels: from brick to brick, and from cell to cell where a brick holds
// something.
//
// Why the walk cannot lose a hit. Let P be the point where the exact ray meets a primitive, at the exact distance t.
// - Along axis k the cells are parted by the planes 1 ... n - 1 (the faces of the bounds do not part cells). The walk
//   gives plane i the distance T(i) = a + i * b, a number that is computed the same way each time, grows with i (or
//   falls, for a backward direction) and puts the plane wrongly by at most 8 * 2^-53 * R along axis k, R being the
//   larger of the ray's distance from the bounds and their size: the rounding of T, divided by |1 / direction|, is
//   that of a difference of coordinates.
// - The walk from brick to brick crosses those planes that part bricks, of all three axes in the order of their T. So there is one moment
//   at which it has crossed exactly those with T <= t. It then is in the brick that was entered at some T <= t.
// - The walk within a brick begins where the planes with T up to that entry's are crossed, and crosses the brick's other planes in the
//   order of their T, until the next one parts bricks, whose T is beyond t. So there is one moment at which exactly the planes with
//   T <= t are crossed, and the cell it is in then holds P but for 8 * 2^-53 * R along each axis.
// - Primitives are listed in every cell that they come nearer to than half of overlap_slack cells
//   (triangle_box_overlap.h). As long as that is more than the error, the primitive is in that cell's list: 2^-17 of
//   a cell's width against 2^-50 * R. R is at most 8 sizes of the bounds, because rays from farther away are moved (ray/cell_ray.h). What
//   that rounds their start by along an axis counts as well: walkable_resolution (grid_choice.h) keeps cells wide enough for both.
// - The walk starts in a brick whose planes behind it have T below the ray's first possible hit, and ends when the
//   next plane lies beyond the last possible one, both by the ray's margin (ray/cell_ray.h). So the moment lies between start and end.
#pragma once

#include "accel/grid/cell_lattice.h"
#include "base/lanes.h"
#include "ray/cell_ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace raywise {

namespace cell_walk_detail {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

// The course of a ray along one axis, over planes that are `step` apart.
struct Course {
    double next = infinity; // T of the next plane; infinite where there is none
    double plane = 0.0;     // its number
    double step = 0.0;      // from plane to plane; negative for a backward direction
    double a = 0.0;         // T(i) = a + i * b
    double b = 0.0;
    std::uint32_t number = 0; // what the place adds to the number of the cell or brick
    std::uint32_t number_step = 0;

    RW_INLINE double distance(double i) const { return a + i * b; }
};

} // namespace cell_walk_detail

// Within a brick.
class CellWalk {
public:
    // The cell's number within the brick.
    std::uint32_t cell() const { return x_.number + y_.number + z_.number; }
    void end_at(double s) { last_s_ = s; }

    // To the next cell. Returns false at the brick's or the ray's end. Branches tell the axis, not a table of three courses: what is guessed
    // right costs nothing, and the courses stay in registers (a sixth of the time of random rays through the bunny).
    RW_INLINE bool step() {
        if (x_.next <= y_.next) {
            if (x_.next <= z_.next) return cross(x_);
        } else if (y_.next <= z_.next) {
            return cross(y_);
        }
        return cross(z_);
    }

private:
    friend class BrickWalk;
    struct Course : cell_walk_detail::Course {
        double border = 0.0;                             // the plane where the brick ends
        double border_next = cell_walk_detail::infinity; // its T; infinite at the face of the bounds
    };

    RW_INLINE bool cross(Course& course) {
        if (course.next > last_s_ || course.plane == course.border) return false;
        course.number += course.number_step;
        course.plane += course.step;
        course.next = course.plane == course.border ? course.border_next : course.distance(course.plane);
        return true;
    }

    Course x_, y_, z_;
    double last_s_ = 0.0; // the s behind which no hit is of use
};

class BrickWalk {
public:
    RW_INLINE BrickWalk(const CellRay& ray, const CellLattice& lattice)
        : ray_(ray), lattice_(lattice), entry_s_(ray.first), last_s_(ray.last) {
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
            entry_s_ = std::max(entry_s_, slab.near);
            last_s_ = std::min(last_s_, slab.far);
        }
        enters_ = entry_s_ <= last_s_;
        if (!enters_) return;
        begin(x_, 0);
        begin(y_, 1);
        begin(z_, 2);
    }

    // Whether the ray meets the box of all cells at all; else there is no brick.
    bool enters() const { return enters_; }
    // Its number, which is that of its first cell over cells_per_brick.
    std::uint32_t brick() const { return x_.number + y_.number + z_.number; }
    // No hit behind s is of use any more.
    void end_at(double s) {
        last_s_ = std::min(last_s_, s);
        enters_ = enters_ && entry_s_ <= last_s_;
    }
    double last_s() const { return last_s_; }

    RW_INLINE bool step() {
        if (x_.next <= y_.next) {
            if (x_.next <= z_.next) return cross(x_);
        } else if (y_.next <= z_.next) {
            return cross(y_);
        }
        return cross(z_);
    }

    // The walk through the brick, from where the ray comes in.
    RW_INLINE CellWalk cells() const {
        CellWalk walk;
        walk.last_s_ = last_s_;
        begin_cells(walk.x_, x_, 0);
        begin_cells(walk.y_, y_, 1);
        begin_cells(walk.z_, z_, 2);
        return walk;
    }

private:
    // A component so small moves the ray by less than 2^-60 of the scene's distance: nothing, against the slack of
    // the lists.
    static constexpr double still = 0x1p-60;

    struct Course : cell_walk_detail::Course {
        double lowest = 0.0;   // place of the brick's first cell
        double cell_count = 0; // along the axis
        bool moves = false;
    };

    // Where the ray is at s, in cells, within the lattice.
    RW_INLINE double place(const Course& course, int axis, double s) const {
        const double position =
            ((ray_.start[axis] - lattice_.bounds.lower[axis]) + (course.moves ? s * ray_.direction[axis] : 0.0)) *
            lattice_.cells_per_unit[axis];
        return std::min(std::max(position, 0.0), course.cell_count - 1.0);
    }

    RW_INLINE void begin(Course& course, int axis) {
        const auto index = static_cast<std::size_t>(axis);
        const AxisNumbers& numbers = lattice_.numbers[index];
        course.cell_count = lattice_.resolution[index];
        if (lattice_.resolution[index] == 1) return;
        const double d = ray_.direction[axis];
        const double side = numbers.brick_mask() + 1.0;
        const std::uint32_t brick_step = numbers.brick_step / cells_per_brick;
        course.moves = std::fabs(d) > still;
        auto brick = static_cast<std::uint32_t>(place(course, axis, entry_s_)) >> numbers.brick_shift;
        course.lowest = brick * side;
        if (course.moves) {
            course.a = (lattice_.bounds.lower[axis] - ray_.start[axis]) * ray_.inverse[axis];
            course.b = lattice_.width[axis] * ray_.inverse[axis];
            // The rounded position may be a plane too far ahead.
            if (d > 0.0) {
                while (course.lowest > 0.0 && course.distance(course.lowest) > entry_s_) {
                    course.lowest -= side;
                    --brick;
                }
                course.step = side;
                course.number_step = brick_step;
                course.plane = course.lowest + side;
            } else {
                while (course.lowest + side < course.cell_count && course.distance(course.lowest + side) > entry_s_) {
                    course.lowest += side;
                    ++brick;
                }
                course.step = -side;
                course.number_step = 0u - brick_step;
                course.plane = course.lowest;
            }
            course.next = next_of(course);
        }
        course.number = brick * brick_step;
    }

    static RW_INLINE double next_of(const Course& course) {
        const bool is_inside = course.plane > 0.0 && course.plane < course.cell_count;
        return is_inside ? course.distance(course.plane) : cell_walk_detail::infinity;
    }

    RW_INLINE bool cross(Course& course) {
        if (course.next > last_s_) return false; // which is finite: the walk ends
        entry_s_ = course.next;
        course.number += course.number_step;
        course.lowest += course.step;
        course.plane += course.step;
        course.next = next_of(course);
        return true;
    }

    RW_INLINE void begin_cells(CellWalk::Course& cells, const Course& bricks, int axis) const {
        const AxisNumbers& numbers = lattice_.numbers[static_cast<std::size_t>(axis)];
        const double side = numbers.brick_mask() + 1.0;
        const double highest = std::min(bricks.lowest + side, bricks.cell_count) - 1.0;
        double at = std::min(std::max(std::floor(place(bricks, axis, entry_s_)), bricks.lowest), highest);
        const std::uint32_t number_step = 1u << numbers.cell_shift;
        if (bricks.moves) {
            cells.a = bricks.a;
            cells.b = bricks.b;
            if (bricks.step > 0.0) {
                while (at > bricks.lowest && cells.distance(at) > entry_s_) at -= 1.0;
                cells.step = 1.0;
                cells.number_step = number_step;
                cells.plane = at + 1.0;
            } else {
                while (at < highest && cells.distance(at + 1.0) > entry_s_) at += 1.0;
                cells.step = -1.0;
                cells.number_step = 0u - number_step;
                cells.plane = at;
            }
            cells.border = std::min(bricks.plane, bricks.cell_count);
            cells.border_next = bricks.next;
            cells.next = cells.plane == cells.border ? cells.border_next : cells.distance(cells.plane);
        }
        cells.number = static_cast<std::uint32_t>(at - bricks.lowest) << numbers.cell_shift;
    }

    const CellRay& ray_;
    const CellLattice& lattice_;
    Course x_, y_, z_;
    double entry_s_; // where the brick was entered
    double last_s_;  // the s behind which no hit is of use
    bool enters_ = false;
};

} // namespace raywise
