// The uniform grid: equal cells, each with the list of primitives that overlap it, and a walk from cell to cell along
// the ray (Fujimoto, Tanaka, Iwata 1986, "ARTS: Accelerated Ray-Tracing System"; GridAccel in Chuang's lecture
// "Acceleration").
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

#include "accel/grid/grid_statistics.h"
#include "accel/traversed_accel.h"
#include "geometry/triangle_block.h"
#include "ray/cell_ray.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace raywise {

// How many cells along each axis: as many as make cells cubes of which `density` times `primitives` fill the box
// (Woo's rule as Havran and Sixta 1999 use it). Axes along which the box is thinner than such a cube, or flat, have
// one cell, and the others share all.
std::array<std::uint32_t, 3> grid_resolution(const Vec3& size, double primitives, double density);

class UniformGrid final : public TraversedAccel<UniformGrid> {
public:
    // Cells per primitive. Random chords through the bunny (69,451 triangles), one thread: 1 cell per triangle took
    // 20 % more time than 4, 2 took 5 % more, 8 took 6 % more and 16 took 15 % more; building took 1, 1.2, 1.5, 1.9
    // and 2.5 times as long at 1, 2, 4, 8 and 16. Soups of small triangles gain up to a sixth more at 8, for as much
    // more memory again.
    static constexpr double default_density = 4.0;

    explicit UniformGrid(const BuildInput& input) : UniformGrid(input, default_density) {}
    UniformGrid(const BuildInput& input, double density);

    std::size_t bytes() const override;

    // All zero without hittable primitives.
    const std::array<std::uint32_t, 3>& resolution() const { return resolution_; }
    // Where each cell's references begin, and the end of all. Cell (i, j, k) is number i + resolution[0] * (j +
    // resolution[1] * k).
    const std::vector<std::uint32_t>& offsets() const { return offsets_; }
    // Primitives, in ascending order within each cell.
    const std::vector<std::uint32_t>& references() const { return references_; }
    // Looks at every cell once or twice.
    GridStatistics statistics() const { return grid_statistics(resolution_, offsets_); }

    template <class Collector>
    void traverse(const ExactRay& ray, Collector& collector) const;

private:
    // One axis of a walk.
    struct Course {
        double next;  // T of the next plane; infinite after the last
        double plane; // its number
        double last;  // the number of the face behind the last plane
        double step;  // 1 or -1
        double a;     // T(i) = a + i * b
        double b;
        std::int64_t stride; // from cell to cell, in cell numbers
    };

    Vec3 lower_{0.0};
    Vec3 upper_{0.0};
    Vec3 cells_per_unit_{0.0}; // 0 along a flat axis
    Vec3 width_{0.0};          // of a cell
    std::array<std::uint32_t, 3> resolution_{};
    std::vector<std::uint32_t> offsets_;
    std::vector<std::uint32_t> references_;
};

template <class Collector>
void UniformGrid::traverse(const ExactRay& exact_ray, Collector& collector) const {
    if (offsets_.empty()) return;
    const CellRay ray(exact_ray, primitives().bounds(), primitives().largest_extent());
    if (!ray.is_known()) return test_all_primitives(exact_ray, collector);

    constexpr double infinity = std::numeric_limits<double>::infinity();
    // A component so small moves the ray by less than 2^-60 of the scene's distance: nothing, against the slack of
    // the lists.
    constexpr double still = 0x1p-60;

    double near = ray.first;
    double far = ray.last;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::fabs(ray.direction[axis]) <= still) {
            // Moved by less than that, and rounded when the ray was.
            const double slack = 0x1p-50 * max_component(magnitudes(ray.start - primitives().bounds().center())) +
                                 0x1p-50 * max_component(primitives().bounds().size());
            if (ray.start[axis] < lower_[axis] - slack || ray.start[axis] > upper_[axis] + slack) return;
            continue;
        }
        const Interval slab = ray.slab(axis, lower_[axis], upper_[axis]);
        near = std::max(near, slab.near);
        far = std::min(far, slab.far);
    }
    if (near > far) return;
    const double start = near;

    std::array<Course, 3> courses;
    std::int64_t cell = 0;
    std::int64_t stride = 1;
    for (int axis = 0; axis < 3; ++axis) {
        Course& course = courses[static_cast<std::size_t>(axis)];
        const std::uint32_t count = resolution_[static_cast<std::size_t>(axis)];
        const double d = ray.direction[axis];
        course.next = infinity;
        if (count > 1) {
            const double highest = count - 1.0;
            const bool moves = std::fabs(d) > still;
            const double position =
                ((ray.start[axis] - lower_[axis]) + (moves ? start * d : 0.0)) * cells_per_unit_[axis];
            double at = std::floor(std::min(std::max(position, 0.0), highest));
            if (moves) {
                course.a = (lower_[axis] - ray.start[axis]) * ray.inverse[axis];
                course.b = width_[axis] * ray.inverse[axis];
                // The rounded position may be a plane too far ahead.
                if (d > 0.0) {
                    while (at > 0.0 && course.a + at * course.b > start) at -= 1.0;
                    course.step = 1.0;
                    course.plane = at + 1.0;
                    course.last = count;
                    course.stride = stride;
                } else {
                    while (at < highest && course.a + (at + 1.0) * course.b > start) at += 1.0;
                    course.step = -1.0;
                    course.plane = at;
                    course.last = 0.0;
                    course.stride = -stride;
                }
                if (course.plane != course.last) course.next = course.a + course.plane * course.b;
            }
            cell += static_cast<std::int64_t>(at) * stride;
        }
        stride *= count;
    }

    // The primitives tested last, each at the place its number says (a mailbox, as in Amanatides and Woo 1987, but on
    // the stack, as many threads ask at once): one that reaches into several cells is tested once for most of them.
    // Random chords need 6 % fewer tests on the bunny (69,451 triangles) and 26 % fewer in a soup of 100,000, and
    // take about a tenth less time.
    std::array<std::uint32_t, 8> tested;
    tested.fill(PrimitiveHit::no_primitive);

    std::uint32_t untested[triangle_block_size];
    double limit = collector.limit();
    for (;;) {
        const std::uint32_t end = offsets_[static_cast<std::size_t>(cell) + 1];
        for (std::uint32_t i = offsets_[static_cast<std::size_t>(cell)]; i < end;) {
            std::uint32_t n = 0;
            for (; i < end && n < triangle_block_size; ++i) {
                const std::uint32_t primitive = references_[i];
                if (tested[primitive % tested.size()] == primitive) continue;
                tested[primitive % tested.size()] = primitive;
                untested[n++] = primitive;
            }
            if (n > 0 && test_primitives(primitives(), exact_ray, untested, n, collector)) return;
        }
        Course& course = courses[0].next <= courses[1].next
                             ? (courses[0].next <= courses[2].next ? courses[0] : courses[2])
                             : (courses[1].next <= courses[2].next ? courses[1] : courses[2]);
        if (collector.limit() < limit) {
            limit = collector.limit();
            far = std::min(far, ray.upper_end(limit));
        }
        if (course.next > far) return; // which is finite: the walk ends
        cell += course.stride;
        course.plane += course.step;
        course.next = course.plane == course.last ? infinity : course.a + course.plane * course.b;
    }
}

} // namespace raywise
